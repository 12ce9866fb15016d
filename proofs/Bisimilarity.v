(** Strong bisimilarity of residuals, from every shared part and in every context, and that it is a congruence. *)
From Coq Require Export FunctionalExtensionality FinFun Permutation.
From Dolphin Require Export Normal_forms.
Set Implicit Arguments.
Unset Strict Implicit.

Section Bisimilarity.
  Context {L : Names} {C : Code}.

  (** {1 Contexts that make no difference} *)

  Definition alike {X : Type} (xs ys : list X) : Prop := forall x, In x xs <-> In x ys.

  Lemma alike_refl X (xs : list X) : alike xs xs. Proof. intros x. reflexivity. Qed.
  Lemma alike_sym X (xs ys : list X) : alike xs ys -> alike ys xs. Proof. intros H x. symmetry. apply H. Qed.
  Lemma alike_trans X (xs ys zs : list X) : alike xs ys -> alike ys zs -> alike xs zs.
  Proof. intros H H' x. rewrite (H x). apply H'. Qed.
  Lemma alike_app X (xs xs' ys ys' : list X) : alike xs xs' -> alike ys ys' -> alike (xs ++ ys) (xs' ++ ys').
  Proof. intros H H' x. rewrite !in_app_iff, (H x), (H' x). reflexivity. Qed.

  Lemma mem_alike v vs ws : alike vs ws -> mem v vs = mem v ws.
  Proof.
    intros H. destruct (mem v ws) eqn:M; [apply mem_spec, H, mem_spec; exact M|].
    apply mem_false. rewrite (H v). apply mem_false. exact M.
  Qed.

  Lemma without_alike vs ws S : alike vs ws -> without vs S = without ws S.
  Proof.
    intros H. unfold without. f_equal. apply functional_extensionality. intros v. rewrite (mem_alike v H). reflexivity.
  Qed.

  Lemma clear_alike ks ks' S : alike ks ks' -> clear ks S = clear ks' S.
  Proof. intros H. unfold clear. rewrite (forget_law ks ks' (space S) H). reflexivity. Qed.

  Lemma does_app ds es S : does (ds ++ es) S = does es (does ds S).
  Proof. unfold does, assigned, posted. rewrite !fold_left_app. reflexivity. Qed.

  Lemma does_cons d ds S : does (d :: ds) S = does ds (does [d] S).
  Proof. apply (does_app [d]). Qed.

  (** Any two deeds that ends of the program do may change places. *)
  Definition ends_commute : Prop := forall d e S,
    may_ensure d = true -> may_ensure e = true -> does [d; e] S = does [e; d] S.

  Lemma does_permuted ds es : ends_commute -> Permutation ds es -> forallb may_ensure ds = true ->
    forall S, does ds S = does es S.
  Proof.
    intros Hc. induction 1 as [|d ds es P IH | d e ds | ds es fs P1 IH1 P2 IH2]; cbn [forallb];
      rewrite ?andb_true_iff; intros H S.
    - reflexivity.
    - rewrite (does_cons d ds), (does_cons d es). apply IH. tauto.
    - change (does ([e; d] ++ ds) S = does ([d; e] ++ ds) S). rewrite !does_app, Hc; tauto.
    - rewrite IH1 by exact H. apply IH2. apply forallb_forall. intros d Hd.
      eapply (proj1 (forallb_forall _ _) H), Permutation_in; [apply Permutation_sym; exact P1 | exact Hd].
  Qed.

  Lemma ensured_allowed r : normal r = true -> forallb may_ensure (ensured r) = true.
  Proof.
    induction r using residual_rect'; cbn [normal ensured forallb]; rewrite ?andb_true_iff; intros Hn; try reflexivity;
      try tauto.
    - destruct Hn as [_ Hn]. rewrite forallb_forall in *. rewrite Forall_forall in H. intros d Hd.
      apply in_flat_map in Hd. destruct Hd as (r & Hr & Hd). specialize (Hn r Hr). rewrite andb_true_iff in Hn.
      exact (proj1 (forallb_forall _ _) (H r Hr (proj1 Hn)) d Hd).
    - rewrite forallb_app, andb_true_iff. tauto.
  Qed.

  (** Which numbers are taken matters as a set. *)
  Lemma after_spec used fuel : forall i, exists k,
    after_ used fuel i = (i + N.of_nat (Datatypes.S k) * generation)%N /\
    (forall j, j < k -> In (i + N.of_nat (Datatypes.S j) * generation)%N used) /\
    (~ In (i + N.of_nat (Datatypes.S k) * generation)%N used \/ k = fuel).
  Proof.
    induction fuel as [|fuel IH]; intros i.
    - exists 0. cbn [after_]. split; [lia | split; [intros j Hj; lia | right; reflexivity]].
    - cbn [after_]. destruct (timer_mem (i + generation)%N used) eqn:M.
      + destruct (IH (i + generation)%N) as (k & Hk & Hj & Hn). exists (Datatypes.S k).
        split; [rewrite Hk; lia | split].
        * intros j H. destruct j as [|j].
          -- apply timer_mem_spec in M. replace (i + N.of_nat 1 * generation)%N with (i + generation)%N by lia. exact M.
          -- replace (i + N.of_nat (Datatypes.S (Datatypes.S j)) * generation)%N
               with (i + generation + N.of_nat (Datatypes.S j) * generation)%N by lia. apply Hj. lia.
        * replace (i + N.of_nat (Datatypes.S (Datatypes.S k)) * generation)%N
            with (i + generation + N.of_nat (Datatypes.S k) * generation)%N by lia.
          destruct Hn as [Hn | ->]; auto.
      + exists 0. split; [lia | split; [intros j Hj; lia | left]]. intros H.
        replace (i + N.of_nat 1 * generation)%N with (i + generation)%N in H by lia.
        apply timer_mem_spec in H. congruence.
  Qed.

  Lemma after_free used fuel i : length used <= fuel -> exists k,
    after_ used fuel i = (i + N.of_nat (Datatypes.S k) * generation)%N /\
    (forall j, j < k -> In (i + N.of_nat (Datatypes.S j) * generation)%N used) /\
    ~ In (i + N.of_nat (Datatypes.S k) * generation)%N used.
  Proof.
    intros Hf. destruct (after_spec used fuel i) as (k & Hk & Hj & [Hn | ->]); [exists k; auto|].
    exists fuel. split; [exact Hk | split; [exact Hj|]]. intros Hin.
    set (f := fun j => (i + N.of_nat (Datatypes.S j) * generation)%N).
    assert (Hd : NoDup (map f (seq 0 (Datatypes.S fuel)))).
    { apply FinFun.Injective_map_NoDup; [|apply seq_NoDup]. intros a b. unfold f, generation. lia. }
    assert (Hi : incl (map f (seq 0 (Datatypes.S fuel))) used).
    { intros x Hx. apply in_map_iff in Hx. destruct Hx as (j & <- & Hx). apply in_seq in Hx. unfold f.
      destruct (Nat.eq_dec j fuel) as [->|]; [exact Hin | apply Hj; lia]. }
    apply NoDup_incl_length in Hi; [|exact Hd]. rewrite map_length, seq_length in Hi.
    exact (Nat.lt_irrefl _ (Nat.le_trans _ _ _ Hi Hf)).
  Qed.

  Lemma after_alike used used' i : alike used used' ->
    after_ used (length used) i = after_ used' (length used') i.
  Proof.
    intros H. destruct (after_free (used := used) i (le_n _)) as (k & -> & Hj & Hn).
    destruct (after_free (used := used') i (le_n _)) as (k' & -> & Hj' & Hn').
    destruct (lt_eq_lt_dec k k') as [[Hlt | ->] | Hlt]; [| reflexivity |].
    - exfalso. apply Hn, H, Hj', Hlt.
    - exfalso. apply Hn', H, Hj, Hlt.
  Qed.

  Lemma fresh_alike i used used' n : alike used used' -> fresh i used n = fresh i used' n.
  Proof. intros H. induction n as [|n IH]; cbn [fresh]; [|rewrite IH]; apply after_alike; exact H. Qed.

  Lemma alloc_made_alike w h S B t q used used' :
    alike used used' -> alloc_made w h S B t q used = alloc_made w h S B t q used'.
  Proof.
    intros H. assert (E : fresh (place q) used = fresh (place q) used')
      by (apply functional_extensionality; intros n; apply fresh_alike; exact H).
    unfold alloc_made, made_at. rewrite E. reflexivity.
  Qed.

  Record similar (K K' : context) : Prop := {
    same_world : world_of K = world_of K';
    same_held : held K = held K';
    same_needed : needed K = needed K';
    same_named : named K = named K';
    same_numbers : alike (taken_numbers K) (taken_numbers K');
    same_recruits : its_recruits K = its_recruits K'
  }.

  Lemma similar_sym K K' : similar K K' -> similar K' K.
  Proof. intros []. split; auto using alike_sym. Qed.

  Lemma own_similar e K K' S r : similar K K' -> own e K S r = own e K' S r.
  Proof.
    destruct K, K'. intros []. cbn in *. subst. destruct r; try reflexivity.
    cbn. destruct e; [reflexivity|].
    rewrite !(alloc_made_alike _ _ _ _ _ _ same_numbers0). reflexivity.
  Qed.

  Lemma lift_similar f K K' t : similar K K' -> lift f K t = lift f K' t.
  Proof. destruct K, K'. intros []. cbn in *. subst. reflexivity. Qed.

  Lemma enter_similar f K K' : similar K K' -> similar (enter f K) (enter f K').
  Proof.
    destruct K, K'. intros []. cbn in *. subst. split; try reflexivity. cbn. apply alike_app;
      [assumption | apply alike_refl].
  Qed.

  Lemma goes_similar e K S r t : goes e K S r t -> forall K', similar K K' -> goes e K' S r t.
  Proof.
    induction 1 as [K S r t H | K S f r t t' _ IH Hl]; intros K' HK.
    - apply Itself. rewrite <- (own_similar e S r HK). exact H.
    - eapply Within; [apply IH, enter_similar, HK|]. rewrite <- (lift_similar f t HK). exact Hl.
  Qed.

  (** The context of a part depends on what the frame names, and on what it is. *)
  Definition kind (f : frame) : nat * list vehicle :=
    match f with Beside _ _ => (1, []) | Held_by _ => (2, []) | In_recruited v => (3, [v]) | _ => (0, []) end.

  Lemma enter_alike f f' K :
    kind f = kind f' -> alike (frame_names f) (frame_names f') -> alike (frame_numbers f) (frame_numbers f') ->
    similar (enter f K) (enter f' K).
  Proof.
    intros Hk Hn Hi.
    assert (E : (fun v => mem v (frame_names f)) = (fun v => mem v (frame_names f'))).
    { apply functional_extensionality. intros v. apply mem_alike. exact Hn. }
    assert (E' : forall g : vehicle -> bool, (fun v => g v || mem v (frame_names f)) = (fun v => g v ||
      mem v (frame_names f'))).
    { intros g. apply functional_extensionality. intros v. rewrite (mem_alike v Hn). reflexivity. }
    split; cbn [enter world_of held needed named taken_numbers its_recruits]; auto.
    - destruct f, f'; cbn [kind] in Hk; try discriminate Hk; auto.
    - destruct f, f'; cbn [kind] in Hk; try discriminate Hk; auto.
    - apply alike_app; [apply alike_refl | exact Hi].
    - destruct f, f'; cbn [kind] in Hk; try discriminate Hk; auto. congruence.
  Qed.

  (** {1 Steps by parts} *)

  Lemma goes_parts e K S r t :
    goes e K S r t <->
    In t (own e K S r) \/
    exists f r1 u, In (f, r1) (parts r) /\ goes e (enter f K) S r1 u /\ In t (lift f K u).
  Proof.
    rewrite <- steps_iff_goes, steps_parts. apply or_iff_compat_l. split.
    - intros (f & r1 & Hp & H). apply in_flat_map in H. destruct H as (u & H1 & H2).
      exists f, r1, u. rewrite <- steps_iff_goes. auto.
    - intros (f & r1 & u & Hp & H1 & H2). exists f, r1. split; [exact Hp|]. apply in_flat_map.
      exists u. rewrite steps_iff_goes. auto.
  Qed.

  Lemma goes_normal e K S r t : goes e K S r t -> normal r = true -> next_normal t.
  Proof.
    induction 1 as [K S r t H | K S f r t t' _ IH Hl]; intros Hn.
    - eapply own_normal; eauto.
    - eapply lift_normal; [exact Hn | | exact Hl]. apply IH. eapply normal_part. exact Hn.
  Qed.

  (** {1 Bisimilarity} *)

  (** What is seen of a part from beside it: the vehicles that it names, those that it runs, its numbers, the keys of
      what is active in it, and what its end does. *)
  Record face (r r' : residual) : Prop := {
    face_names : alike (names r) (names r');
    face_run : alike (run_of r) (run_of r');
    face_numbers : alike (numbers r) (numbers r');
    face_normal : normal r = true;
    face_normal' : normal r' = true;
    face_keys : alike (keys r) (keys r');
    face_ends : forall S, does (ensured r) S = does (ensured r') S
  }.

  (** The same label, the same S, and the same outcome. *)
  Definition agree (R : residual -> residual -> Prop) (t t' : transition) : Prop :=
    match t, t' with
    | By l S1 o _, By l' S1' o' _ =>
        l = l' /\ S1 = S1' /\
        match o, o' with
        | Next r, Next r' => R r r'
        | Ok, Ok => True
        | Err m, Err m' => m = m'
        | Ends x, Ends x' => x = x'
        | _, _ => False
        end
    end.

  Definition simulates (R : residual -> residual -> Prop) (r r' : residual) : Prop :=
    forall e K S t, goes e K S r t -> exists t', goes e K S r' t' /\ agree R t t'.

  Record bisimulation (R : residual -> residual -> Prop) : Prop := {
    symmetric : forall r r', R r r' -> R r' r;
    same_face : forall r r', R r r' -> face r r';
    same_steps : forall r r', R r r' -> simulates R r r'
  }.

  Definition bisimilar (r r' : residual) : Prop := exists R, bisimulation R /\ R r r'.

  Lemma face_refl r : normal r = true -> face r r.
  Proof. intros H. split; auto using alike_refl. Qed.
  Lemma face_sym r r' : face r r' -> face r' r.
  Proof. intros []. split; auto using alike_sym. Qed.
  Lemma face_trans r r' r'' : face r r' -> face r' r'' -> face r r''.
  Proof. intros [] []. split; eauto using alike_trans. intros S. etransitivity; eauto. Qed.

  Lemma agree_more (R R' : residual -> residual -> Prop) t t' :
    (forall r r', R r r' -> R' r r') -> agree R t t' -> agree R' t t'.
  Proof.
    intros H. destruct t as [l S o E], t' as [l' S' o' E']. intros (H1 & H2 & H3).
    split; [exact H1 | split; [exact H2|]]. destruct o, o'; auto.
  Qed.

  Lemma simulates_more (R R' : residual -> residual -> Prop) r r' :
    (forall r r', R r r' -> R' r r') -> simulates R r r' -> simulates R' r r'.
  Proof.
    intros H Hs e K S t Hg. destruct (Hs e K S t Hg) as (t' & Hg' & Ha). exists t'. eauto using agree_more.
  Qed.

  Lemma bisimilar_face r r' : bisimilar r r' -> face r r'.
  Proof. intros (R & HR & H). eapply same_face; eassumption. Qed.
  Lemma bisimilar_steps r r' : bisimilar r r' -> simulates bisimilar r r'.
  Proof.
    intros (R & HR & H). eapply simulates_more; [|eapply same_steps; eassumption]. intros a b Hab. exists R. auto.
  Qed.
  Theorem bisimilar_sym r r' : bisimilar r r' -> bisimilar r' r.
  Proof. intros (R & HR & H). exists R. split; [exact HR | eapply symmetric; eassumption]. Qed.

  Lemma agree_refl (R : residual -> residual -> Prop) t t' :
    (forall r, normal r = true -> R r r) -> next_normal t ->
    match t, t' with By l S1 o _, By l' S1' o' _ => l = l' /\ S1 = S1' /\ o = o' end -> agree R t t'.
  Proof.
    destruct t as [l S o E], t' as [l' S' o' E']. intros HR Hn (-> & -> & <-). split; [reflexivity | split;
      [reflexivity|]].
    destruct o; auto.
  Qed.

  Theorem bisimilar_refl r : normal r = true -> bisimilar r r.
  Proof.
    intros H. exists (fun a b => a = b /\ normal a = true). split; [|auto]. split.
    - intros a b (-> & Hb). auto.
    - intros a b (-> & Hb). apply face_refl, Hb.
    - intros a b (-> & Hb) e K S t Hg. exists t. split; [exact Hg|].
      apply agree_refl; [auto | eapply goes_normal; eassumption | destruct t; auto].
  Qed.

  Lemma agree_trans (R R' : residual -> residual -> Prop) t t' t'' :
    agree R t t' -> agree R' t' t'' -> agree (fun a c => exists b, R a b /\ R' b c) t t''.
  Proof.
    destruct t as [l S o E], t' as [l' S' o' E'], t'' as [l2 S2 o2 E2]. intros (-> & -> & H) (-> & -> & H').
    split; [reflexivity | split; [reflexivity|]].
    destruct o, o', o2; try contradiction; try congruence; eauto.
  Qed.

  Theorem bisimilar_trans r r' r'' : bisimilar r r' -> bisimilar r' r'' -> bisimilar r r''.
  Proof.
    intros H H'. exists (fun a c => exists b, bisimilar a b /\ bisimilar b c). split; [|eauto]. split.
    - intros a c (b & H1 & H2). exists b. auto using bisimilar_sym.
    - intros a c (b & H1 & H2). eapply face_trans; apply bisimilar_face; eassumption.
    - intros a c (b & H1 & H2) e K S t Hg. destruct (bisimilar_steps H1 Hg) as (t' & Hg' & Ha).
      destruct (bisimilar_steps H2 Hg') as (t2 & Hg2 & Ha2). exists t2. split; [exact Hg2|].
      eapply agree_trans; eassumption.
  Qed.

  (** To show it: a relation whose steps lead to itself, or to what is bisimilar. *)
  Definition up (Q : residual -> residual -> Prop) (r r' : residual) : Prop := Q r r' \/ bisimilar r r'.

  Lemma up_refl Q r : normal r = true -> up Q r r.
  Proof. right. apply bisimilar_refl. assumption. Qed.

  Lemma by_relation (Q : residual -> residual -> Prop) :
    (forall r r', Q r r' -> face r r' /\ simulates (up Q) r r' /\ simulates (up (fun a b => Q b a)) r' r) ->
    forall r r', Q r r' -> bisimilar r r'.
  Proof.
    intros HQ r r' H. exists (fun a b => Q a b \/ Q b a \/ bisimilar a b). split; [|auto]. split.
    - intros a b [Hab | [Hab | Hab]]; auto using bisimilar_sym.
    - intros a b [Hab | [Hab | Hab]].
      + apply HQ, Hab.
      + apply face_sym, HQ, Hab.
      + apply bisimilar_face, Hab.
    - intros a b [Hab | [Hab | Hab]].
      + destruct (HQ a b Hab) as (_ & H1 & _). eapply simulates_more; [|exact H1]. intros x y [Hxy | Hxy]; auto.
      + destruct (HQ b a Hab) as (_ & _ & H1). eapply simulates_more; [|exact H1]. intros x y [Hxy | Hxy]; auto.
      + eapply simulates_more; [|apply bisimilar_steps, Hab]. intros x y Hxy; auto.
  Qed.

  Lemma by_symmetric_relation (Q : residual -> residual -> Prop) :
    (forall r r', Q r r' -> Q r' r) -> (forall r r', Q r r' -> face r r' /\ simulates (up Q) r r') ->
    forall r r', Q r r' -> bisimilar r r'.
  Proof.
    intros Hs HQ. apply by_relation. intros r r' H. split; [apply HQ, H | split; [apply HQ, H|]].
    eapply simulates_more; [|apply HQ, Hs, H]. intros x y [Hxy | Hxy]; [left; auto | right; exact Hxy].
  Qed.
End Bisimilarity.
