(** Bisimilarity is a congruence: each operator keeps it, in each of its parts, those that are yet to come too. *)
From Dolphin Require Export Bisimilarity.
Set Implicit Arguments.
Unset Strict Implicit.

Section Congruence.
  Context {L : Names} {C : Code}.

  Lemma alike_flat_map X Y (f g : X -> list Y) before after x x' :
    (forall y, f y = g y) -> alike (f x) (g x') ->
    alike (flat_map f (before ++ x :: after)) (flat_map g (before ++ x' :: after)).
  Proof.
    intros E H. rewrite !flat_map_app. cbn [flat_map].
    rewrite (flat_map_ext f g E before), (flat_map_ext f g E after).
    apply alike_app; [apply alike_refl | apply alike_app; [exact H | apply alike_refl]].
  Qed.

  Lemma agree_more' (R : residual -> residual -> Prop) t t' : agree eq t t' -> next_normal t ->
    (forall r, normal r = true -> R r r) -> agree R t t'.
  Proof.
    destruct t as [l S1 o E], t' as [l' S1' o' E']. intros (H1 & H2 & H3) Hn HR. split; [exact H1 | split; [exact H2|]].
    destruct o, o'; auto. subst. auto.
  Qed.

  Lemma agree_self t : agree eq t t.
  Proof. destruct t as [l S1 o E]. cbn. destruct o; auto. Qed.

  Lemma next_agree t t' : agree eq t t' -> next_normal t' -> next_normal t.
  Proof.
    destruct t as [l S1 o E], t' as [l' S1' o' E']. intros (_ & _ & H) Hn. destruct o, o'; cbn in *; auto;
      try contradiction.
    subst. exact Hn.
  Qed.

  (** {1 Frames around one part} *)

  Definition is_beside (f : frame) : bool := match f with Beside _ _ => true | _ => false end.

  Lemma goes_plug e K S f r t : is_beside f = false ->
    (goes e K S (plug f r) t <->
     In t (own e K S (plug f r)) \/ exists u, goes e (enter f K) S r u /\ In t (lift f K u)).
  Proof.
    intros Hf. rewrite goes_parts. apply or_iff_compat_l. split.
    - intros (f' & r1 & u & Hp & H1 & H2). destruct f; try discriminate Hf; cbn in Hp; destruct Hp as [Hp | []];
        injection Hp as <- <-; exists u; auto.
    - intros (u & H1 & H2). exists f, r, u. split; [apply in_parts; reflexivity | auto].
  Qed.

  Definition simple (f : frame) : bool := match f with Beside _ _ | In_sequence _ => false | _ => true end.

  Lemma simple_not_beside f : simple f = true -> is_beside f = false.
  Proof. destruct f; auto; discriminate. Qed.

  Lemma face_plug f r r' : simple f = true -> normal (plug f r) = true -> face r r' -> face (plug f r) (plug f r').
  Proof.
    intros Hf Hn [H1 H2 H3 H4 H5 H6 H7].
    split; [ | | | exact Hn | destruct f; try discriminate Hf; cbn [plug normal] in *; rewrite ?andb_true_iff in *;
      tauto | | ].
    - destruct f; try discriminate Hf; cbn [plug names]; try assumption;
        try (apply alike_app; [assumption | apply alike_refl]).
      + apply alike_app; [apply alike_refl | assumption].
      + intros w. cbn. rewrite (H1 w). reflexivity.
    - destruct f; try discriminate Hf; exact H2.
    - destruct f; try discriminate Hf; cbn [plug numbers]; try assumption;
        try (apply alike_app; [assumption | apply alike_refl]).
      + intros j. cbn. rewrite (H3 j). reflexivity.
      + apply alike_app; [apply alike_refl | assumption].
    - destruct f; try discriminate Hf; cbn [plug keys]; try assumption.
      apply alike_app; [apply alike_refl | assumption].
    - destruct f; try discriminate Hf; cbn [plug ensured]; try assumption.
      intros S. rewrite !does_app, H7. reflexivity.
  Qed.

  (** The steps of the node itself: cuts. *)
  Lemma own_plug e K S f r r' t : simple f = true -> face r r' ->
    In t (own e K S (plug f r)) -> exists t', In t' (own e K S (plug f r')) /\ agree eq t t'.
  Proof.
    intros Hf Hr Ht.
    assert (E : forall S1, does (ensured r) (without (run_of r) S1) = does (ensured r') (without (run_of r') S1))
      by (intros S1; rewrite (without_alike S1 (face_run Hr)); apply (face_ends Hr)).
    destruct f; try discriminate Hf; cbn [plug own] in *; try contradiction.
    - unfold guarded, coded, breaks in *. destruct e; [contradiction|].
      destruct (runs g [] K S) as [x s N0 ds | m ds | m ds | m s N0 ds |]; try contradiction;
        [destruct (truth x) as [[]|], k | destruct (is_unknown m) | |]; try contradiction; destruct Ht as [<- | []];
        eexists; (split; [left; reflexivity|]); cbn; rewrite ?E; auto.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); try contradiction. destruct Ht as [<- | []].
      eexists. split; [left; reflexivity|]. cbn. rewrite E. destruct k; cbn; auto.
  Qed.

  Lemma lift_agree f K t t' u : simple f = true -> agree bisimilar t t' -> next_normal u ->
    In u (lift f K t) -> exists u', In u' (lift f K t') /\
      agree (fun a b => bisimilar a b \/ exists r r', bisimilar r r' /\ a = plug f r /\ b = plug f r') u u'.
  Proof.
    destruct t as [l S1 o E], t' as [l' S1' o' E']. intros Hf (<- & <- & Ho) Hn Hu.
    assert (HR : forall r, normal r = true ->
      bisimilar r r \/ exists r0 r', bisimilar r0 r' /\ r = plug f r0 /\ r = plug f r').
    { intros r Hr. left. apply bisimilar_refl. exact Hr. }
    destruct o as [r | | m | x], o' as [r' | | m' | x']; try contradiction.
    - destruct Hu as [<- | []]. eexists. split; [left; reflexivity|].
      cbn. split; [reflexivity | split; [reflexivity|]]. right. exists r, r'.
      destruct f; try discriminate Hf; auto.
    - destruct Hu as [<- | []]. eexists. split; [left; reflexivity|].
      destruct f; try discriminate Hf; try (apply agree_refl; auto; cbn; auto; fail).
      destruct g; apply agree_refl; auto; cbn; auto.
    - subst m'. destruct f; try discriminate Hf; cbn [lift on_err] in *;
        try (destruct Hu as [<- | []]; eexists; split; [left; reflexivity | cbn; auto]; fail).
      unfold on_error in *. destruct (handles_error (handles h) m K S1) as [x s gone N0 ds | m' ds | m' ds |
        m' s gone N0 ds |];
        try contradiction; try (destruct Hu as [<- | []]; eexists; split; [left; reflexivity | cbn; auto]; fail).
      destruct x; [ | | destruct (anew h) as [(t0 & q)|] | destruct (anew h) as [(t0 & q)|];
        [destruct (deepest <=? depth q)|]];
        destruct Hu as [<- | []]; eexists; (split; [left; reflexivity|]); apply agree_refl; cbn; auto.
    - subst x'. destruct Hu as [<- | []]. eexists. split; [left; reflexivity | cbn; auto].
  Qed.

  (** [until], [assure], [during], [within], [watch], rounds, running branches, [holding], [recruited], [fresh],
      [ensure]: for the part that is active. *)
  Theorem frames_congruent f r r' :
    simple f = true -> normal (plug f r) = true -> bisimilar r r' -> bisimilar (plug f r) (plug f r').
  Proof.
    intros Hf Hn Hr.
    apply (@by_symmetric_relation _ _ (fun a b => normal a = true /\ normal b = true /\
      exists r r', bisimilar r r' /\ a = plug f r /\ b = plug f r')).
    - intros a b (Ha & Hb & r0 & r1 & H & -> & ->). split; [exact Hb | split; [exact Ha|]].
      exists r1, r0. auto using bisimilar_sym.
    - clear r r' Hn Hr. intros a b (Ha & Hb & r & r' & H & -> & ->).
      assert (F := bisimilar_face H). split; [apply face_plug; assumption|].
      intros e K S t Ht. assert (Nt := goes_normal Ht Ha).
      apply goes_plug in Ht; [|apply simple_not_beside, Hf]. destruct Ht as [Ht | (u & Hu & Hl)].
      + destruct (own_plug (r' := r') Hf F Ht) as (t' & Ht' & Hag). exists t'.
        split; [apply Itself; exact Ht'|]. eapply agree_more'; [exact Hag | exact Nt | intros; apply up_refl;
          assumption].
      + destruct (bisimilar_steps H Hu) as (u' & Hu' & Hag).
        destruct (lift_agree Hf Hag Nt Hl) as (t' & Ht' & Hag'). exists t'.
        assert (G : goes e K S (plug f r') t').
        { apply goes_plug; [apply simple_not_beside, Hf|]. right. exists u'. auto. }
        split; [exact G|]. assert (Nt' := goes_normal G Hb).
        destruct t as [l S1 o E], t' as [l' S1' o' E']. destruct Hag' as (E1 & E2 & E3).
        split; [exact E1 | split; [exact E2|]]. destruct o, o'; auto.
        destruct E3 as [E3 | (r2 & r2' & E3 & -> & ->)]; [right; exact E3|].
        left. split; [exact Nt | split; [exact Nt'|]]. exists r2, r2'. auto.
    - split; [exact Hn | split]; [|exists r, r'; auto].
      apply (face_plug Hf Hn (bisimilar_face Hr)).
  Qed.

  (** {1 One after the other} *)

  Theorem sequence_assoc a b c : sequence (sequence a b) c = sequence a (sequence b c).
  Proof. induction a; cbn [sequence]; try reflexivity. rewrite IHa2. reflexivity. Qed.

  Lemma alike_names_sequence a b : alike (names (sequence a b)) (names a ++ names b).
  Proof. intros v. rewrite names_sequence, in_app_iff. reflexivity. Qed.

  Lemma alike_numbers_sequence a b : alike (numbers (sequence a b)) (numbers a ++ numbers b).
  Proof.
    induction a; cbn [sequence numbers]; try apply alike_refl.
    rewrite <- app_assoc. apply alike_app; [apply alike_refl | exact IHa2].
  Qed.

  Lemma run_of_sequence a b : run_of (sequence a b) = run_of a.
  Proof. unfold run_of. rewrite running_sequence. reflexivity. Qed.

  Lemma begun_sequence a b : begun (sequence a b) = begun a.
  Proof. unfold begun. rewrite waits_sequence. reflexivity. Qed.

  Lemma lift_sequences b c K u :
    lift (In_sequence (sequence b c)) K u =
    flat_map (lift (In_sequence c) K) (lift (In_sequence b) (enter (In_sequence c) K) u).
  Proof.
    destruct u as [l S1 o E]. destruct o; cbn; try reflexivity.
    - rewrite sequence_assoc. reflexivity.
    - rewrite begun_sequence, keys_sequence. reflexivity.
  Qed.

  Lemma enter_sequences b c K :
    similar (enter (In_sequence (sequence b c)) K) (enter (In_sequence b) (enter (In_sequence c) K)).
  Proof.
    assert (E : forall g : vehicle -> bool,
      (fun v => g v || mem v (names (sequence b c))) = (fun v => (g v || mem v (names c)) || mem v (names b))).
    { intros g. apply functional_extensionality. intros v. rewrite (mem_alike v (alike_names_sequence b c)).
      destruct (g v); [reflexivity|]. cbn. destruct (mem v (names c)) eqn:M1; cbn.
      - apply mem_spec. apply mem_spec in M1. apply in_app_iff. auto.
      - destruct (mem v (names b)) eqn:M2.
        + apply mem_spec. apply mem_spec in M2. apply in_app_iff. auto.
        + apply mem_false. apply mem_false in M1. apply mem_false in M2. rewrite in_app_iff. tauto. }
    split; cbn; auto.
    - intros i. rewrite !in_app_iff, (alike_numbers_sequence b c i), in_app_iff. tauto.
    - rewrite !app_nil_r. reflexivity.
  Qed.

  (** The steps of [r >> t], whatever [r] is. *)
  Lemma goes_sequence e K S r t u :
    goes e K S (sequence r t) u <->
    exists v, goes e (enter (In_sequence t) K) S r v /\ In u (lift (In_sequence t) K v).
  Proof.
    assert (Plain : forall a b, goes e K S (Sequence a b) u <->
      exists v, goes e (enter (In_sequence b) K) S a v /\ In u (lift (In_sequence b) K v)).
    { intros a b. change (Sequence a b) with (plug (In_sequence b) a). rewrite goes_plug by reflexivity.
      cbn [plug own]. split; [intros [[] | H]; exact H | auto]. }
    destruct r; try apply Plain. cbn [sequence]. rewrite Plain. split.
    - intros (v & Hv & Hu). rewrite lift_sequences in Hu. apply in_flat_map in Hu. destruct Hu as (w & Hw & Hu).
      exists w. split; [|exact Hu]. change (Sequence r1 r2) with (plug (In_sequence r2) r1).
      eapply Within; [eapply goes_similar; [exact Hv | apply enter_sequences] | exact Hw].
    - intros (w & Hw & Hu). change (Sequence r1 r2) with (plug (In_sequence r2) r1) in Hw.
      apply goes_plug in Hw; [|reflexivity]. destruct Hw as [[] | (v & Hv & Hw)]. exists v.
      split; [eapply goes_similar; [exact Hv | apply similar_sym, enter_sequences]|].
      rewrite lift_sequences. apply in_flat_map. exists w. auto.
  Qed.

  Lemma face_sequence r r' t t' : face r r' -> face t t' -> face (sequence r t) (sequence r' t').
  Proof.
    intros [] []. split; try (apply normal_sequence; assumption).
    - eapply alike_trans; [apply alike_names_sequence|]. eapply alike_trans; [|apply alike_sym, alike_names_sequence].
      apply alike_app; assumption.
    - rewrite !run_of_sequence. assumption.
    - eapply alike_trans; [apply alike_numbers_sequence|]. eapply alike_trans;
      [|apply alike_sym, alike_numbers_sequence].
      apply alike_app; assumption.
    - rewrite !keys_sequence. assumption.
    - intros S. rewrite !ensured_sequence. auto.
  Qed.

  Theorem sequences_congruent r r' t t' :
    bisimilar r r' -> bisimilar t t' -> bisimilar (sequence r t) (sequence r' t').
  Proof.
    intros Hr Ht.
    apply (@by_symmetric_relation _ _ (fun a b => exists r r' t t',
      bisimilar r r' /\ bisimilar t t' /\ a = sequence r t /\ b = sequence r' t')).
    - intros a b (x & x' & y & y' & H1 & H2 & -> & ->). exists x', x, y', y. auto using bisimilar_sym.
    - clear. intros a b (r & r' & t & t' & Hr & Ht & -> & ->).
      assert (F := bisimilar_face Hr). assert (F' := bisimilar_face Ht). split; [apply face_sequence; assumption|].
      intros e K S u Hu. apply goes_sequence in Hu. destruct Hu as (v & Hv & Hu).
      destruct (bisimilar_steps Hr (goes_similar Hv (K' := enter (In_sequence t') K)
        (enter_alike (f := In_sequence t) (f' := In_sequence t') K eq_refl (face_names F') (face_numbers F')))) as
          (v' & Hv' & Ha).
      destruct v as [l S1 o E], v' as [l' S1' o' E']. destruct Ha as (<- & <- & Ho).
      destruct o as [x | | m | x], o' as [x' | | m' | x']; try contradiction; destruct Hu as [<- | []];
        (eexists; split; [apply goes_sequence; eexists; split; [exact Hv' | left; reflexivity]|]);
        (split; [reflexivity | split; [try reflexivity; apply clear_alike, face_keys, F'|]]); auto.
      + left. exists x, x', t, t'. auto.
      + right. exact Ht.
    - exists r, r', t, t'. auto.
  Qed.

  (** {1 Rounds} *)

  Theorem rounds_congruent r r' more g t t' : some_left more = true ->
    bisimilar r r' -> bisimilar t t' -> bisimilar (Repeat r more g t) (Repeat r' more g t').
  Proof.
    intros Hm Hr Ht.
    apply (@by_symmetric_relation _ _ (fun a b => exists r r' more t t', some_left more = true /\
      bisimilar r r' /\ bisimilar t t' /\
      ((a = Repeat r more g t /\ b = Repeat r' more g t') \/
       exists g', g = Some g' /\ a = Asked more g' t /\ b = Asked more g' t'))).
    - intros a b (x & x' & n & y & y' & Hn & H1 & H2 & H). exists x', x, n, y', y.
      split; [exact Hn | split; [auto using bisimilar_sym | split; [auto using bisimilar_sym|]]].
      destruct H as [(-> & ->) | (g' & -> & -> & ->)]; [left; auto | right; exists g'; auto].
    - clear. intros a b (r & r' & more & t & t' & Hm & Hr & Ht & Hab).
      assert (F := bisimilar_face Hr). assert (F' := bisimilar_face Ht).
      pose proof F as [F1 F2 F3 F4 F5 F6 F7]. pose proof F' as [G1 G2 G3 G4 G5 G6 G7].
      assert (Clear : forall S, clear (keys t) S = clear (keys t') S) by (intros; apply clear_alike; exact G6).
      assert (Next_round : forall g0, (g0 = g) ->
        up (fun a b => exists r r' more t t', some_left more = true /\ bisimilar r r' /\ bisimilar t t' /\
             ((a = Repeat r more g t /\ b = Repeat r' more g t') \/
              exists g', g = Some g' /\ a = Asked more g' t /\ b = Asked more g' t'))
           (repeat_ t (option_map pred more) g0 t) (repeat_ t' (option_map pred more) g0 t')).
      { intros g0 ->. destruct more as [[|[|n]]|]; cbn [option_map pred repeat_]; try discriminate Hm.
        - right. exact Ht.
        - left. exists t, t', (Some (Datatypes.S n)), t, t'. split; [reflexivity|]. auto.
        - left. exists t, t', None, t, t'. split; [reflexivity|]. auto. }
      destruct Hab as [(-> & ->) | (g' & -> & -> & ->)].
      + split.
        { split; try (cbn [normal]; rewrite ?F4, ?F5, ?Hm, ?G4, ?G5; reflexivity); cbn [names numbers];
            try (apply alike_app; assumption); [exact F2 | exact F6 | exact F7]. }
        intros e K S u Hu. change (Repeat r more g t) with (plug (Round_of more g t) r) in Hu.
        apply goes_plug in Hu; [|reflexivity]. destruct Hu as [[] | (v & Hv & Hu)].
        destruct (bisimilar_steps Hr (goes_similar Hv (K' := enter (Round_of more g t') K)
          (enter_alike (f := Round_of more g t) (f' := Round_of more g t') K eq_refl G1 G3))) as (v' & Hv' & Ha).
        assert (Step : forall u', In u' (lift (Round_of more g t') K v') -> goes e K S (Repeat r' more g t') u').
        { intros u' Hu'. change (Repeat r' more g t') with (plug (Round_of more g t') r').
          eapply Within; eassumption. }
        destruct v as [l S1 o E], v' as [l' S1' o' E']. destruct Ha as (<- & <- & Ho).
        destruct o as [x | | m | x], o' as [x' | | m' | x']; try contradiction.
        * destruct Hu as [<- | []]. eexists. split; [apply Step; left; reflexivity|].
          split; [reflexivity | split; [reflexivity|]]. left. exists x, x', more, t, t'.
          split; [exact Hm | split; [exact Ho | split; [exact Ht | left; split; reflexivity]]].
        * destruct g as [g|]; destruct Hu as [<- | []]; (eexists; split; [apply Step; left; reflexivity|]);
            (split; [reflexivity | split; [try reflexivity; apply Clear|]]).
          -- left. exists r, r', more, t, t'. split; [exact Hm | split; [exact Hr | split; [exact Ht|]]].
             right. exists g. auto.
          -- apply Next_round. reflexivity.
        * destruct Hu as [<- | []]. eexists. split; [apply Step; left; reflexivity|]. cbn. auto.
        * destruct Hu as [<- | []]. eexists. split; [apply Step; left; reflexivity|]. cbn. auto.
      + split.
        { split; try (cbn [normal]; rewrite ?Hm, ?G4, ?G5; reflexivity); try assumption; apply alike_refl. }
        intros e K S u Hu. apply goes_parts in Hu. destruct Hu as [Hu | (f & r1 & v & [] & _)].
        cbn [own] in Hu. unfold guarded, coded, breaks in Hu.
        assert (Step : forall u', In u' (own e K S (Asked more g' t')) -> goes e K S (Asked more g' t') u')
          by (intros; apply Itself; assumption).
        cbn [own] in Step. unfold guarded, coded, breaks in Step.
        destruct e; [contradiction|].
        destruct (runs g' [] K S) as [x s N0 ds | m ds | m ds | m s N0 ds |]; try contradiction;
          [destruct (truth x) as [[]|] | destruct (is_unknown m) | |]; try contradiction; destruct Hu as [<- | []];
          (eexists; split; [apply Step; left; reflexivity|]);
          (split; [reflexivity | split; [try reflexivity; apply Clear|]]); auto.
    - exists r, r', more, t, t'. split; [exact Hm | split; [exact Hr | split; [exact Ht | left; split; reflexivity]]].
  Qed.
  (** {1 Side by side} *)

  Lemma through_numbers : through numbers. Proof. intros rs. reflexivity. Qed.
  Lemma through_run_of : through run_of.
  Proof. intros rs. unfold run_of. cbn [running]. apply map_flat_map. Qed.

  Lemma flat_branch x : is_parallel x = false -> flat x = [x].
  Proof. destruct x; auto. discriminate. Qed.

  Lemma flats_branches rs : branches_of rs = true -> flat_map flat rs = rs.
  Proof.
    unfold branches_of. induction rs as [|x rs IH]; [reflexivity|]. cbn [forallb flat_map]. rewrite !andb_true_iff.
    intros ((_ & H1) & H2). rewrite flat_branch, IH; auto. destruct (is_parallel x); [discriminate | reflexivity].
  Qed.

  Lemma parallel_branches rs : branches_of rs = true -> 2 <= length rs -> parallel rs = Parallel rs.
  Proof.
    intros H Hl. unfold parallel. rewrite flats_branches by exact H. destruct rs as [|x [|y rs]]; cbn in Hl; auto; lia.
  Qed.

  Lemma parallel_flat x : normal x = true -> parallel (flat x) = x.
  Proof.
    intros H. destruct (is_parallel x) eqn:P.
    - destruct x; try discriminate. cbn [flat normal] in *. rewrite andb_true_iff in H. destruct H as [H1 H2].
      apply parallel_branches; [exact H2 | apply Nat.leb_le; exact H1].
    - rewrite (flat_branch P). unfold parallel. cbn. rewrite (flat_branch P). reflexivity.
  Qed.

  Lemma flat_parallel rs : branches_of rs = true -> rs <> [] -> flat (parallel rs) = rs.
  Proof.
    intros H Hn. destruct rs as [|x [|y rs]]; [congruence | |].
    - unfold branches_of in H. cbn in H. rewrite !andb_true_iff in H. destruct H as ((H1 & H2) & _).
      assert (P : is_parallel x = false) by (destruct (is_parallel x); [discriminate | reflexivity]).
      rewrite <- (flat_branch P), parallel_flat by exact H1. reflexivity.
    - rewrite parallel_branches; [reflexivity | exact H | cbn; lia].
  Qed.

  (** Where [x] stands between [B] and [A]. *)
  Definition hole (B : list residual) (x : residual) (A : list residual) : residual := Parallel (B ++ flat x ++ A).
  Definition around (B A : list residual) : Prop := branches_of (B ++ A) = true /\ B ++ A <> [].

  Lemma branches_hole B x A : around B A -> normal x = true ->
    branches_of (B ++ flat x ++ A) = true /\ 2 <= length (B ++ flat x ++ A).
  Proof.
    intros (H & Hn) Hx. destruct (normal_flat x Hx) as [F1 F2]. rewrite branches_app in *. rewrite andb_true_iff in H.
    rewrite branches_app, F1. destruct H as [-> ->]. split; [reflexivity|]. rewrite !app_length.
    destruct (flat x); [congruence|]. destruct B, A; cbn in *; try lia. congruence.
  Qed.

  Lemma normal_hole B x A : around B A -> normal x = true -> normal (hole B x A) = true.
  Proof. intros H Hx. destruct (branches_hole H Hx). apply normal_of_branches; assumption. Qed.

  Lemma parallel_hole B x A : branches_of (B ++ A) = true -> normal x = true ->
    (B ++ A = [] /\ parallel (B ++ flat x ++ A) = x) \/ (around B A /\ parallel (B ++ flat x ++ A) = hole B x A).
  Proof.
    intros H Hx. destruct (B ++ A) as [|y ys] eqn:E.
    - left. split; [reflexivity|]. apply app_eq_nil in E. destruct E as [-> ->]. rewrite app_nil_r.
      apply parallel_flat, Hx.
    - right. assert (Ha : around B A) by (split; rewrite E; [exact H | discriminate]). split; [exact Ha|].
      destruct (branches_hole Ha Hx). apply parallel_branches; assumption.
  Qed.

  (** What the step of a part is for the whole. *)
  Definition surround (B A : list residual) (v : transition) : transition :=
    match v with
    | By l S1 (Next r) E => By l S1 (Next (Parallel (B ++ flat r ++ A))) E
    | By l S1 Ok E => By l S1 (Next (parallel (B ++ A))) E
    | By l S1 (Err m) E =>
        By l (does (flat_map ensured (B ++ A)) (without (flat_map run_of (B ++ A)) S1)) (Err m) (E ++ cut (B ++ A))
    | By l S1 (Ends x) E => By l S1 (Ends x) E
    end.

  Lemma lift_beside B A K v : lift (Beside B A) K v = [surround B A v].
  Proof. destruct v as [l S1 [] E]; reflexivity. Qed.

  Lemma without_twice vs ws S : without vs (without ws S) = without (ws ++ vs) S.
  Proof.
    unfold without, with_allocation. cbn [allocation variables bound space]. f_equal.
    apply functional_extensionality. intros v. destruct (mem v (ws ++ vs)) eqn:M.
    - apply mem_spec in M. apply in_app_iff in M. destruct (mem v vs) eqn:M1; [reflexivity|]. apply mem_false in M1.
      destruct (mem v ws) eqn:M2; [reflexivity|]. apply mem_false in M2. destruct M; contradiction.
    - apply mem_false in M. rewrite in_app_iff in M. destruct (mem v vs) eqn:M1; [apply mem_spec in M1; tauto|].
      destruct (mem v ws) eqn:M2; [apply mem_spec in M2; tauto | reflexivity].
  Qed.

  Lemma ensured_branches rs : branches_of rs = true -> forallb may_ensure (flat_map ensured rs) = true.
  Proof.
    intros H. apply branches_normal in H. rewrite forallb_forall in *. intros d Hd. apply in_flat_map in Hd.
    destruct Hd as (r & Hr & Hd). exact (proj1 (forallb_forall _ _) (ensured_allowed (H r Hr)) d Hd).
  Qed.

  (** Where ends do deeds of parts side by side in another order, these must be able to change places. *)
  Section Side_by_side.
  Hypothesis commute : ends_commute.

  Lemma surround_twice B A b a v : around B A -> around b a ->
    agree eq (surround (B ++ b) (a ++ A) v) (surround B A (surround b a v)).
  Proof.
    intros HB (Hb & Hn). destruct v as [l S1 [r | | m | x] E]; cbn [surround].
    - split; [reflexivity | split; [reflexivity|]]. cbn [flat]. rewrite <- !app_assoc. reflexivity.
    - split; [reflexivity | split; [reflexivity|]]. rewrite flat_parallel by assumption.
      replace ((B ++ b) ++ a ++ A) with (B ++ (b ++ a) ++ A) by (rewrite <- !app_assoc; reflexivity).
      apply parallel_branches.
      + destruct HB as [HB _]. rewrite branches_app in *. rewrite branches_app. rewrite andb_true_iff in HB.
        destruct HB as [-> ->]. rewrite branches_app, Hb. reflexivity.
      + destruct HB as [_ HB]. rewrite !app_length. destruct B, A, b, a; cbn in *; try congruence; lia.
    - split; [reflexivity | split; [|reflexivity]].
      change (without (flat_map run_of (B ++ A)) (does (flat_map ensured (b ++ a))
        (without (flat_map run_of (b ++ a)) S1))) with (does (flat_map ensured (b ++ a))
        (without (flat_map run_of (B ++ A)) (without (flat_map run_of (b ++ a)) S1))).
      rewrite without_twice, <- does_app.
      rewrite (without_alike (vs := flat_map run_of ((B ++ b) ++ a ++ A))
        (ws := flat_map run_of (b ++ a) ++ flat_map run_of (B ++ A)))
        by (intros v; rewrite !flat_map_app, !in_app_iff; tauto).
      apply does_permuted; [exact commute | | apply ensured_branches].
      + rewrite !flat_map_app, <- !app_assoc. rewrite (app_assoc (flat_map ensured b)).
        rewrite (app_assoc (flat_map ensured b) _ (flat_map ensured B ++ _)).
        apply Permutation_app_swap_app.
      + destruct HB as [HB _]. rewrite !branches_app, !andb_true_iff in *. tauto.
    - cbn. auto.
  Qed.

  Lemma enter_twice B A b a K :
    similar (enter (Beside (B ++ b) (a ++ A)) K) (enter (Beside b a) (enter (Beside B A) K)).
  Proof.
    assert (E : forall g : vehicle -> bool,
      (fun v => g v || mem v (flat_map names ((B ++ b) ++ a ++ A))) =
      (fun v => (g v || mem v (flat_map names (B ++ A))) || mem v (flat_map names (b ++ a)))).
    { intros g. apply functional_extensionality. intros v. destruct (g v); [reflexivity|]. cbn.
      destruct (mem v (flat_map names (B ++ A))) eqn:M1; cbn.
      - apply mem_spec. apply mem_spec in M1. rewrite !flat_map_app, !in_app_iff in *. tauto.
      - apply mem_false in M1. destruct (mem v (flat_map names (b ++ a))) eqn:M2.
        + apply mem_spec. apply mem_spec in M2. rewrite !flat_map_app, !in_app_iff in *. tauto.
        + apply mem_false. apply mem_false in M2. rewrite !flat_map_app, !in_app_iff in *. tauto. }
    split; cbn; auto.
    - intros i. rewrite !flat_map_app, !in_app_iff. tauto.
    - rewrite !app_nil_r. reflexivity.
  Qed.

  Lemma split_branches b r a : branches_of (b ++ r :: a) = true -> 2 <= length (b ++ r :: a) -> around b a.
  Proof.
    intros H Hl. split.
    - rewrite branches_app in *. unfold branches_of in H at 2. cbn [forallb] in H. rewrite !andb_true_iff in *. tauto.
    - rewrite app_length in Hl. cbn in Hl. destruct b, a; cbn in *; try discriminate. lia.
  Qed.

  (** A branch of [x] moves: [x] moves. *)
  Lemma hole_forward B x A b r a e K S v : around B A -> normal x = true -> flat x = b ++ r :: a ->
    goes e (enter (Beside (B ++ b) (a ++ A)) K) S r v ->
    exists w, goes e (enter (Beside B A) K) S x w /\ agree eq (surround (B ++ b) (a ++ A) v) (surround B A w).
  Proof.
    intros HB Hx F Hv. destruct (is_parallel x) eqn:P.
    - destruct x; try discriminate. cbn [flat] in F. subst rs. cbn [normal] in Hx. rewrite andb_true_iff in Hx.
      destruct Hx as [H1 H2]. apply Nat.leb_le in H1. assert (Hb := split_branches H2 H1).
      exists (surround b a v). split; [|apply surround_twice; assumption].
      change (Parallel (b ++ r :: a)) with (plug (Beside b a) r).
      eapply Within; [eapply goes_similar; [exact Hv | apply enter_twice] | rewrite lift_beside; left; reflexivity].
    - rewrite (flat_branch P) in F. destruct b as [|y b]; [|destruct b; discriminate].
      injection F as <- <-. rewrite app_nil_r in *. exists v. split; [exact Hv | apply agree_self].
  Qed.

  (** And conversely. *)
  Lemma hole_backward B x A e K S w : around B A -> normal x = true -> goes e (enter (Beside B A) K) S x w ->
    exists u, goes e K S (hole B x A) u /\ agree eq (surround B A w) u.
  Proof.
    intros HB Hx Hw. unfold hole. destruct (is_parallel x) eqn:P.
    - destruct x; try discriminate. cbn [flat]. cbn [normal] in Hx. rewrite andb_true_iff in Hx.
      destruct Hx as [H1 H2]. apply Nat.leb_le in H1.
      apply goes_parts in Hw. destruct Hw as [[] | (f & r1 & v & Hp & Hv & Hw)].
      apply in_parts in Hp. destruct f; try discriminate Hp. injection Hp as ->.
      rewrite lift_beside in Hw. destruct Hw as [<- | []]. assert (Hb := split_branches H2 H1).
      exists (surround (B ++ before) (after ++ A) v). split.
      + replace (B ++ (before ++ r1 :: after) ++ A) with ((B ++ before) ++ r1 :: (after ++ A))
          by (rewrite <- !app_assoc; reflexivity).
        change (Parallel ((B ++ before) ++ r1 :: (after ++ A))) with (plug (Beside (B ++ before) (after ++ A)) r1).
        eapply Within; [eapply goes_similar; [exact Hv | apply similar_sym, enter_twice]|].
        rewrite lift_beside. left. reflexivity.
      + assert (G := surround_twice v HB Hb).
        destruct (surround (B ++ before) (after ++ A) v), (surround B A (surround before after v)).
        destruct G as (G1 & G2 & G3). split; [auto | split; [auto|]]. destruct o, o0; auto.
    - rewrite (flat_branch P). exists (surround B A w). split.
      + change (Parallel (B ++ [x] ++ A)) with (plug (Beside B A) x).
        eapply Within; [exact Hw | rewrite lift_beside; left; reflexivity].
      + apply agree_self.
  Qed.

  Lemma three_ways X (b : list X) r a B M A : b ++ r :: a = B ++ M ++ A ->
    (exists c, B = b ++ r :: c /\ a = c ++ M ++ A) \/
    (exists b1 a1, M = b1 ++ r :: a1 /\ b = B ++ b1 /\ a = a1 ++ A) \/
    (exists c, A = c ++ r :: a /\ b = B ++ M ++ c).
  Proof.
    revert B M. induction b as [|y b IH]; intros B M H.
    - destruct B as [|z B]; cbn in H.
      + destruct M as [|z M]; cbn in H.
        * right. right. exists []. subst. auto.
        * injection H as -> ->. right. left. exists [], M. auto.
      + injection H as -> ->. left. exists B. auto.
    - destruct B as [|z B]; cbn in H.
      + destruct M as [|z M]; cbn in H.
        * right. right. exists (y :: b). subst. auto.
        * injection H as -> H. destruct (IH [] M H) as [(c & Hc & _) | [(b1 & a1 & -> & -> & ->) | (c & -> & ->)]].
          -- destruct b; discriminate.
          -- right. left. exists (z :: b1), a1. auto.
          -- right. right. exists c. auto.
      + injection H as -> H. destruct (IH B M H) as [(c & -> & ->) | [(b1 & a1 & -> & -> & ->) | (c & -> & ->)]].
        * left. exists c. auto.
        * right. left. exists b1, a1. auto.
        * right. right. exists c. auto.
  Qed.

  Lemma agree_eq_both (R : residual -> residual -> Prop) t t1 t2 t' :
    agree eq t t1 -> agree R t1 t2 -> agree eq t2 t' -> agree R t t'.
  Proof.
    destruct t as [l S1 o E], t1 as [l1 S2 o1 E1], t2 as [l2 S3 o2 E2], t' as [l' S4 o' E'].
    intros (-> & -> & H1) (-> & -> & H2) (-> & -> & H3). split; [reflexivity | split; [reflexivity|]].
    destruct o, o1, o2, o'; try contradiction; try congruence; auto.
  Qed.

  Lemma alike_hole X (f : residual -> list X) B x x' A : through f -> alike (f x) (f x') ->
    alike (flat_map f (B ++ flat x ++ A)) (flat_map f (B ++ flat x' ++ A)).
  Proof.
    intros Hf H. rewrite !flat_map_app, !(@through_flat _ _ _ _ Hf).
    apply alike_app; [apply alike_refl | apply alike_app; [exact H | apply alike_refl]].
  Qed.

  Lemma does_hole B x x' A : (forall S, does (ensured x) S = does (ensured x') S) ->
    forall S, does (flat_map ensured (B ++ flat x ++ A)) S = does (flat_map ensured (B ++ flat x' ++ A)) S.
  Proof.
    intros H S. rewrite !flat_map_app, !(@through_flat _ _ _ _ through_ensured), !does_app, H. reflexivity.
  Qed.

  Lemma face_hole B x x' A : around B A -> face x x' -> face (hole B x A) (hole B x' A).
  Proof.
    intros HB [H1 H2 H3 H4 H5 H6 H7]. split; try (apply normal_hole; assumption); unfold hole.
    - apply (alike_hole (f := names)); [apply through_names | exact H1].
    - rewrite !through_run_of. apply alike_hole; [apply through_run_of | exact H2].
    - apply (alike_hole (f := numbers)); [apply through_numbers | exact H3].
    - apply (alike_hole (f := keys)); [apply through_keys | exact H6].
    - cbn [ensured]. apply does_hole. exact H7.
  Qed.

  Definition in_hole (p q : residual) : Prop :=
    exists B x x' A, around B A /\ bisimilar x x' /\ p = hole B x A /\ q = hole B x' A.

  (** A part beside the hole moves. *)
  Lemma beside_agree b a b' a' v :
    next_normal v -> alike (flat_map run_of (b ++ a)) (flat_map run_of (b' ++ a')) ->
    (forall S, does (flat_map ensured (b ++ a)) S = does (flat_map ensured (b' ++ a')) S) ->
    (forall r, normal r = true -> up in_hole (Parallel (b ++ flat r ++ a)) (Parallel (b' ++ flat r ++ a'))) ->
    up in_hole (parallel (b ++ a)) (parallel (b' ++ a')) ->
    agree (up in_hole) (surround b a v) (surround b' a' v).
  Proof.
    intros Hn Hr He H1 H2. destruct v as [l S1 [r | | m | x] E]; cbn [surround].
    - split; [reflexivity | split; [reflexivity | apply H1; exact Hn]].
    - split; [reflexivity | split; [reflexivity | exact H2]].
    - split; [reflexivity | split; [rewrite (without_alike S1 Hr); apply He | reflexivity]].
    - cbn. auto.
  Qed.

  Lemma up_hole B x x' A : bisimilar x x' -> branches_of (B ++ A) = true ->
    up in_hole (parallel (B ++ flat x ++ A)) (parallel (B ++ flat x' ++ A)).
  Proof.
    intros H Hb. destruct (bisimilar_face H) as [_ _ _ H4 H5].
    destruct (parallel_hole Hb H4) as [(E & ->) | (Ha & ->)], (parallel_hole Hb H5) as [(E' & ->) | (Ha' & ->)].
    - right. exact H.
    - destruct Ha' as [_ Ha']. congruence.
    - destruct Ha as [_ Ha]. congruence.
    - left. exists B, x, x', A. auto.
  Qed.

  Lemma holes_step p q : in_hole p q -> simulates (up in_hole) p q.
  Proof.
    intros (B & x & x' & A & HB & Hx & -> & ->) e K S u Hu.
    pose proof (bisimilar_face Hx) as [F1 F2 F3 F4 F5 F6 F7].
    assert (Hnp := normal_hole HB F4). assert (Nu := goes_normal Hu Hnp).
    apply goes_parts in Hu. destruct Hu as [[] | (f & r & v & Hp & Hv & Hu)].
    assert (Nr : normal r = true).
    { apply in_parts in Hp. apply (normal_part f). rewrite <- Hp. exact Hnp. }
    assert (Nv := goes_normal Hv Nr).
    apply in_parts in Hp. destruct f; try discriminate Hp. unfold hole in Hp. injection Hp as Hp.
    rewrite lift_beside in Hu. destruct Hu as [<- | []]. symmetry in Hp.
    destruct HB as [HB1 HB2]. pose proof HB1 as HB3. rewrite branches_app, andb_true_iff in HB1.
      destruct HB1 as [BB BA].
    destruct (three_ways Hp) as [(c & -> & ->) | [(b1 & a1 & F & -> & ->) | (c & -> & ->)]].
    - (* before the hole *)
      assert (Hb := split_branches (b := before) (r := r) (a := c ++ A)).
      assert (Bc : branches_of (before ++ c) = true).
      { rewrite branches_app in *. unfold branches_of in BB at 2. cbn [forallb] in BB. rewrite !andb_true_iff in *.
        tauto. }
      exists (surround before (c ++ flat x' ++ A) v). split.
      + unfold hole. rewrite <- app_assoc. cbn.
        change (Parallel (before ++ r :: c ++ flat x' ++ A)) with (plug (Beside before (c ++ flat x' ++ A)) r).
        eapply Within; [|rewrite lift_beside; left; reflexivity]. eapply goes_similar; [exact Hv|].
        apply enter_alike; [reflexivity | |]; cbn [frame_names frame_numbers];
          rewrite !app_assoc, <- !(app_assoc _ _ A).
        * apply alike_hole; [apply through_names | exact F1].
        * apply alike_hole; [apply through_numbers | exact F3].
      + apply beside_agree; [exact Nv | | | |].
        * rewrite !app_assoc, <- !(app_assoc _ _ A). apply alike_hole; [apply through_run_of | exact F2].
        * rewrite !app_assoc, <- !(app_assoc _ _ A). apply does_hole. exact (face_ends (bisimilar_face Hx)).
        * intros r0 Hr0. left. destruct (normal_flat r0 Hr0) as [G1 G2]. exists (before ++ flat r0 ++ c), x, x', A.
          split; [|split; [exact Hx | unfold hole; rewrite <- !app_assoc; auto]]. split.
          -- rewrite !branches_app in *. rewrite G1, BA. rewrite !andb_true_iff in *. tauto.
          -- destruct before; cbn; try discriminate. destruct (flat r0); [congruence | discriminate].
        * rewrite !app_assoc, <- !(app_assoc _ _ A). apply up_hole; [exact Hx|].
          rewrite branches_app, Bc, BA. reflexivity.
    - (* in the hole *)
      assert (HB : around B A) by (split; assumption).
      destruct (hole_forward HB F4 F Hv) as (w & Hw & Ha).
      destruct (bisimilar_steps Hx Hw) as (w' & Hw' & Ha').
      destruct (hole_backward HB F5 Hw') as (u' & Hu' & Ha2).
      exists u'. split; [exact Hu'|]. eapply agree_eq_both; [exact Ha | | exact Ha2].
      assert (Nw := goes_normal Hw F4).
      destruct w as [l S1 o E], w' as [l' S1' o' E']. destruct Ha' as (<- & <- & Ho).
      destruct o as [y | | m | y], o' as [y' | | m' | y']; try contradiction; cbn [surround];
        (split; [reflexivity | split; [try subst; reflexivity|]]); try exact Ho.
      + left. exists B, y, y', A. auto.
      + apply up_refl. apply normal_parallel; [exact HB2 | apply branches_normal; exact HB3].
    - (* after it *)
      assert (Bc : branches_of (c ++ after) = true).
      { rewrite branches_app in *. unfold branches_of in BA at 2. cbn [forallb] in BA. rewrite !andb_true_iff in *.
        tauto. }
      exists (surround (B ++ flat x' ++ c) after v). split.
      + unfold hole.
        replace (B ++ flat x' ++ c ++ r :: after) with ((B ++ flat x' ++ c) ++ r :: after) by (rewrite <- !app_assoc;
          reflexivity).
        change (Parallel ((B ++ flat x' ++ c) ++ r :: after)) with (plug (Beside (B ++ flat x' ++ c) after) r).
        eapply Within; [|rewrite lift_beside; left; reflexivity]. eapply goes_similar; [exact Hv|].
        apply enter_alike; [reflexivity | |]; cbn [frame_names frame_numbers]; rewrite <- !app_assoc.
        * apply alike_hole; [apply through_names | exact F1].
        * apply alike_hole; [apply through_numbers | exact F3].
      + apply beside_agree; [exact Nv | | | |].
        * rewrite <- !app_assoc. apply alike_hole; [apply through_run_of | exact F2].
        * rewrite <- !app_assoc. apply does_hole. exact (face_ends (bisimilar_face Hx)).
        * intros r0 Hr0. left. destruct (normal_flat r0 Hr0) as [G1 G2]. exists B, x, x', (c ++ flat r0 ++ after).
          split; [|split; [exact Hx | unfold hole; rewrite <- !app_assoc; auto]]. split.
          -- rewrite !branches_app in *. rewrite G1, BB. rewrite !andb_true_iff in *. tauto.
          -- destruct B; cbn; try discriminate. destruct c; cbn; try discriminate.
             destruct (flat r0); [congruence | discriminate].
        * rewrite <- !app_assoc. apply up_hole; [exact Hx|]. rewrite branches_app, BB, Bc. reflexivity.
  Qed.

  Lemma holes_bisimilar p q : in_hole p q -> bisimilar p q.
  Proof.
    apply by_symmetric_relation.
    - intros a b (B & x & x' & A & HB & Hx & -> & ->). exists B, x', x, A. auto using bisimilar_sym.
    - intros a b H. split; [|apply holes_step; exact H]. destruct H as (B & x & x' & A & HB & Hx & -> & ->).
      apply face_hole; [exact HB | apply bisimilar_face; exact Hx].
  Qed.

  (** In any place of a [|]. *)
  Theorem parallels_congruent B x x' A : branches_of (B ++ A) = true -> bisimilar x x' ->
    bisimilar (parallel (B ++ flat x ++ A)) (parallel (B ++ flat x' ++ A)).
  Proof.
    intros HB Hx. destruct (up_hole Hx HB) as [H | H]; [apply holes_bisimilar; exact H | exact H].
  Qed.
  End Side_by_side.

  (** {1 Branches} *)

  (** Code in the place of a branch's task is given the values that the guard took, and its end may give back the
      pairs; other tasks are not. *)
  Fixpoint plain (r : residual) : bool :=
    match r with
    | Made a _ _ => negb (has_parameters a)
    | Ensure r es =>
        plain r && (1 <=? length es) && forallb (fun e => match e with Gives_back => false | _ => true end) es
    | _ => true
    end.

  Lemma given_plain ds r : plain r = true -> given ds r = r.
  Proof.
    induction r; auto; cbn [plain given]; [destruct (has_parameters a); [discriminate | reflexivity]|].
    rewrite !andb_true_iff. intros ((H1 & H2) & H3). rewrite IHr by exact H1.
    assert (E : given_back ds ds0 = ds0).
    { clear H2. induction ds0 as [|e es IH]; [reflexivity|]. cbn [forallb] in H3. rewrite andb_true_iff in H3.
      unfold given_back in *. cbn [flat_map]. rewrite IH by tauto. destruct e; try reflexivity.
      destruct H3; discriminate. }
    rewrite E. destruct ds0; [discriminate | reflexivity].
  Qed.

  Lemma choose_agree (R : residual -> residual -> Prop) e K S around around' b y a b' y' a' t :
    fst y = fst y' -> alike (keys (snd y)) (keys (snd y')) ->
    (forall ds, R (around (b ++ a) (given ds (snd y))) (around' (b' ++ a') (given ds (snd y')))) ->
    In t (choose e K S around b y a) -> exists t', In t' (choose e K S around' b' y' a') /\ agree R t t'.
  Proof.
    intros Hg Hk HR. unfold choose, guarded, coded, breaks. rewrite <- Hg. destruct e; [intros []|].
    destruct (runs (fst y) [] K S) as [x s N0 ds | m ds | m ds | m s N0 ds |]; try (intros []; fail);
      [destruct (truth x) as [[]|] | destruct (is_unknown m) | |]; try (intros []; fail); intros [<- | []];
      eexists; (split; [left; reflexivity|]); cbn; rewrite ?(clear_alike _ Hk); auto.
  Qed.

  Definition branch_hole (before : list branch) (g : code) (x : residual) (after : list branch) : list branch :=
    before ++ (g, x) :: after.

  Definition in_branch (p q : residual) : Prop :=
    exists before g x x' after,
      bisimilar x x' /\ plain x = true /\ plain x' = true /\
      forallb (fun b => normal (snd b)) (before ++ after) = true /\
      let bs := branch_hole before g x after in
      let bs' := branch_hole before g x' after in
      (p = One_of bs /\ q = One_of bs') \/ (before ++ after <> [] /\ p = All_of bs /\ q = All_of bs') \/
      (exists r, normal r = true /\ p = Branch r bs /\ q = Branch r bs').

  Lemma alike_branches X (f : residual -> list X) before g x x' after : alike (f x) (f x') ->
    alike (flat_map (fun b => f (snd b)) (branch_hole before g x after))
      (flat_map (fun b => f (snd b)) (branch_hole before g x' after)).
  Proof.
    intros H. unfold branch_hole. rewrite !flat_map_app. cbn [flat_map snd].
    apply alike_app; [apply alike_refl | apply alike_app; [exact H | apply alike_refl]].
  Qed.

  Lemma normal_branch_hole before g x after :
    normal x = true -> forallb (fun b => normal (snd b)) (before ++ after) = true ->
    forallb (fun b => normal (snd b)) (branch_hole before g x after) = true.
  Proof.
    unfold branch_hole. rewrite !forallb_app, !andb_true_iff. cbn [forallb snd]. intros H1 [H2 H3]. rewrite H1. auto.
  Qed.

  Lemma face_branch p q : in_branch p q -> face p q.
  Proof.
    intros (before & g & x & x' & after & Hx & _ & _ & Hn & H). destruct (bisimilar_face Hx) as [F1 F2 F3 F4 F5 F6 F7].
    assert (N1 := normal_branch_hole g F4 Hn). assert (N2 := normal_branch_hole g F5 Hn).
    assert (L1 : forall y, 1 <=? length (branch_hole before g y after) = true).
    { intros y. apply Nat.leb_le. unfold branch_hole. rewrite app_length. cbn. lia. }
    assert (A1 := alike_branches before g after F1). assert (A3 := alike_branches before g after F3).
    destruct H as [(-> & ->) | [(Hne & -> & ->) | (r & Hr & -> & ->)]].
    - split; try assumption; try apply alike_refl; try reflexivity; cbn [normal]; rewrite L1; assumption.
    - assert (L2 : forall y, 2 <=? length (branch_hole before g y after) = true).
      { intros y. apply Nat.leb_le. unfold branch_hole. rewrite app_length. cbn.
        destruct before, after; cbn in *; try congruence; lia. }
      split; try assumption; try apply alike_refl; try reflexivity; cbn [normal]; rewrite L2; assumption.
    - split; try (cbn [normal]; rewrite Hr, L1; assumption); cbn [names numbers run_of running];
        try apply alike_refl; try reflexivity; (apply alike_app; [apply alike_refl | assumption]).
  Qed.

  Lemma branch_of_congruent x x' (others : list branch) : bisimilar x x' ->
    forallb (fun b => normal (snd b)) others = true -> bisimilar (branch_of x others) (branch_of x' others).
  Proof.
    intros Hx Hn. destruct others as [|z bs]; [exact Hx|].
    change (bisimilar (plug (Branch_of (z :: bs)) x) (plug (Branch_of (z :: bs)) x')).
    apply frames_congruent; [reflexivity | | exact Hx]. cbn [plug normal]. rewrite (face_normal (bisimilar_face Hx)).
    cbn [length Nat.leb andb]. exact Hn.
  Qed.

  Lemma all_of_hole before g x x' after :
    bisimilar x x' -> plain x = true -> plain x' = true ->
    forallb (fun b => normal (snd b)) (before ++ after) = true ->
    in_branch (all_of (branch_hole before g x after)) (all_of (branch_hole before g x' after)).
  Proof.
    intros Hx P P' Hn. exists before, g, x, x', after.
    split; [exact Hx | split; [exact P | split; [exact P' | split; [exact Hn|]]]]. cbn zeta.
    destruct before as [|b before]; [destruct after as [|a after]|].
    - left. split; reflexivity.
    - right. left. split; [discriminate | split; reflexivity].
    - right. left. split; [discriminate|]. destruct before; split; reflexivity.
  Qed.

  Lemma branch_of_hole r before g x x' after :
    bisimilar x x' -> plain x = true -> plain x' = true -> normal r = true ->
    forallb (fun b => normal (snd b)) (before ++ after) = true ->
    in_branch (branch_of r (branch_hole before g x after)) (branch_of r (branch_hole before g x' after)).
  Proof.
    intros Hx P P' Hr Hn. exists before, g, x, x', after.
    split; [exact Hx | split; [exact P | split; [exact P' | split; [exact Hn|]]]]. cbn zeta. right. right. exists r.
    split; [exact Hr|]. destruct before; split; reflexivity.
  Qed.

  (** Choosing, of all branches or of one. *)
  Lemma choosing before g x x' after e K S (surrounds : list branch -> residual -> residual) t :
    bisimilar x x' -> plain x = true -> plain x' = true ->
    forallb (fun b => normal (snd b)) (before ++ after) = true ->
    (surrounds = (fun others r => branch_of r others) \/ surrounds = (fun _ r => r)) ->
    In t (each (choose e K S surrounds) [] (branch_hole before g x after)) ->
    exists t', In t' (each (choose e K S surrounds) [] (branch_hole before g x' after)) /\ agree (up in_branch) t t'.
  Proof.
    intros Hx P P' Hn Hs Ht. destruct (bisimilar_face Hx) as [F1 F2 F3 F4 F5 F6 F7].
    apply in_each in Ht. destruct Ht as (b & y & a & Hb & Ht). cbn [app] in Ht.
    assert (Found : forall b' y' a', branch_hole before g x' after = b' ++ y' :: a' -> fst y = fst y' ->
      alike (keys (snd y)) (keys (snd y')) ->
      (forall ds, up in_branch (surrounds (b ++ a) (given ds (snd y))) (surrounds (b' ++ a') (given ds (snd y')))) ->
      exists t', In t' (each (choose e K S surrounds) [] (branch_hole before g x' after)) /\ agree (up in_branch) t t').
    { intros b' y' a' E Hf Hk HR. destruct (choose_agree (b' := b') (a' := a') Hf Hk HR Ht) as (t' & Ht' & Hag).
      exists t'. split; [|exact Hag]. apply in_each. exists b', y', a'. auto. }
    assert (Parts : forall z, In z (before ++ after) -> normal (snd z) = true) by (apply forallb_forall; exact Hn).
    unfold branch_hole in Hb. change ((g, x) :: after) with ([(g, x)] ++ after) in Hb. symmetry in Hb.
    destruct (three_ways Hb) as [(c & -> & ->) | [(b1 & a1 & E & -> & ->) | (c & -> & ->)]].
    - assert (Ny : normal (snd y) = true) by (apply Parts, in_app_iff; left; apply in_elt).
      apply (Found b y (c ++ (g, x') :: after)); [unfold branch_hole; rewrite <- app_assoc; reflexivity |
        reflexivity | apply alike_refl |].
      intros ds. assert (Ng : normal (given ds (snd y)) = true) by (apply normal_given; exact Ny).
      destruct Hs as [-> | ->]; [left | apply up_refl; exact Ng].
      assert (Nbc : forallb (fun b => normal (snd b)) ((b ++ c) ++ after) = true)
        by (apply forallb_forall; intros z Hz; apply Parts; rewrite !in_app_iff in *; cbn; tauto).
      assert (Q := branch_of_hole g Hx P P' Ng Nbc). unfold branch_hole in Q. rewrite <- !app_assoc in Q. exact Q.
    - destruct b1 as [|z b1]; [|destruct b1; discriminate]. injection E as <- <-. rewrite app_nil_r in *.
      cbn [app] in *.
      apply (Found before (g, x') after); [reflexivity | reflexivity | exact F6 |]. intros ds. cbn [snd].
      rewrite !given_plain by assumption. right. destruct Hs as [-> | ->]; [|exact Hx].
      apply branch_of_congruent; [exact Hx | exact Hn].
    - assert (Ny : normal (snd y) = true) by (apply Parts, in_app_iff; right; apply in_elt).
      apply (Found (before ++ (g, x') :: c) y a); [unfold branch_hole; rewrite <- app_assoc;
        reflexivity | reflexivity | apply alike_refl |].
      intros ds. assert (Ng : normal (given ds (snd y)) = true) by (apply normal_given; exact Ny).
      destruct Hs as [-> | ->]; [left | apply up_refl; exact Ng].
      assert (Nca : forallb (fun b => normal (snd b)) (before ++ c ++ a) = true)
        by (apply forallb_forall; intros z Hz; apply Parts; rewrite !in_app_iff in *; cbn; tauto).
      assert (Q := branch_of_hole g Hx P P' Ng Nca). unfold branch_hole in Q. rewrite <- !app_assoc. exact Q.
  Qed.

  Lemma in_branch_sym p q : in_branch p q -> in_branch q p.
  Proof.
    intros (before & g & x & x' & after & Hx & P & P' & Hn & H). exists before, g, x', x, after.
    split; [apply bisimilar_sym; exact Hx | split; [exact P' | split; [exact P | split; [exact Hn|]]]].
    destruct H as [(-> & ->) | [(Hne & -> & ->) | (r & Hr & -> & ->)]]; eauto 6.
  Qed.

  Theorem branches_congruent p q : in_branch p q -> bisimilar p q.
  Proof.
    apply by_symmetric_relation; [exact in_branch_sym|]. intros a b H. split; [apply face_branch; exact H|].
    pose proof H as (before & g & x & x' & after & Hx & P & P' & Hn & Hab).
      destruct (bisimilar_face Hx) as [F1 F2 F3 F4 F5 F6 F7].
    intros e K S t Ht. assert (Nt := goes_normal Ht (face_normal (face_branch H))).
    destruct Hab as [(-> & ->) | [(Hne & -> & ->) | (r & Hr & -> & ->)]].
    - apply goes_parts in Ht. destruct Ht as [Ht | (f & r1 & u & [] & _)]. cbn [own] in Ht.
      destruct (choosing Hx P P' Hn (or_intror eq_refl) Ht) as (t' & Ht' & Hag). exists t'.
      split; [apply Itself; exact Ht' | exact Hag].
    - apply goes_parts in Ht. destruct Ht as [Ht | (f & r1 & u & [] & _)]. cbn [own] in Ht.
      destruct (choosing Hx P P' Hn (or_introl eq_refl) Ht) as (t' & Ht' & Hag). exists t'.
      split; [apply Itself; exact Ht' | exact Hag].
    - set (bs := branch_hole before g x after) in *. set (bs' := branch_hole before g x' after).
      change (Branch r bs) with (plug (Branch_of bs) r) in Ht. apply goes_plug in Ht; [|reflexivity].
      destruct Ht as [[] | (u & Hu & Ht)].
      assert (Hu' : goes e (enter (Branch_of bs') K) S r u).
      { eapply goes_similar; [exact Hu|]. apply enter_alike; [reflexivity | |]; apply alike_branches; assumption. }
      assert (Step : forall t', In t' (lift (Branch_of bs') K u) -> goes e K S (Branch r bs') t').
      { intros t' Ht'. change (Branch r bs') with (plug (Branch_of bs') r). eapply Within; eassumption. }
      assert (Nu := goes_normal Hu Hr).
      destruct u as [l S1 [r1 | | m | y] E]; destruct Ht as [<- | []]; (eexists; split; [apply Step; left;
        reflexivity|]);
        (split; [reflexivity | split; [reflexivity|]]); auto.
      + left. exists before, g, x, x', after. split; [exact Hx | split; [exact P | split; [exact P' | split;
        [exact Hn|]]]].
        right. right. exists r1. auto.
      + left. apply all_of_hole; assumption.
  Qed.

  (** {1 What asks for its time or its rounds first} *)

  Theorem during_code_congruent k i d r r' :
    bisimilar r r' -> bisimilar (During_code k i d r) (During_code k i d r').
  Proof.
    intros Hr. apply (@by_symmetric_relation _ _ (fun a b => exists r r', bisimilar r r' /\
      a = During_code k i d r /\ b = During_code k i d r')).
    - intros a b (x & x' & H & -> & ->). exists x', x. auto using bisimilar_sym.
    - clear. intros a b (r & r' & Hr & -> & ->). destruct (bisimilar_face Hr) as [F1 F2 F3 F4 F5 F6 F7]. split.
      { split; auto; try apply alike_refl. intros j. cbn. rewrite (F3 j). reflexivity. }
      intros e K S t Ht. apply goes_parts in Ht. destruct Ht as [Ht | (f & r1 & u & [] & _)].
      assert (Step : forall u', In u' (own e K S (During_code k i d r')) -> goes e K S (During_code k i d r') u')
        by (intros; apply Itself; assumption).
      cbn [own] in Ht, Step. unfold coded, breaks in Ht, Step. destruct e; [contradiction|].
      destruct (runs d [] K S) as [x s N0 ds | m ds | m ds | m s N0 ds |]; try contradiction;
        [destruct (time_of d x) as [n|m] | | |]; destruct Ht as [<- | []];
        (eexists; split; [apply Step; left; reflexivity|]);
        (split; [reflexivity | split; [try reflexivity; apply clear_alike; exact F6|]]); auto.
      right. change (bisimilar (plug (Body_during k i n) r) (plug (Body_during k i n) r')).
      apply frames_congruent; auto.
    - exists r, r'. auto.
  Qed.
End Congruence.
