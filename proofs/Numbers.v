(** No two timers, questions, recruits or keys of a residual have one number, but for those of the rounds of one
    [repeat]. So each number that is cancelled, expires or is answered is that of one wait. *)
From Dolphin Require Export Once Congruence.
Set Implicit Arguments.
Unset Strict Implicit.

Section Numbers.
  Context {L : Names} {C : Code}.

  Definition disjoint (xs ys : list timer) : Prop := forall i, In i xs -> ~ In i ys.

  Fixpoint separate (ls : list (list timer)) : Prop :=
    match ls with [] => True | l :: ls => disjoint l (concat ls) /\ separate ls end.

  Lemma disjoint_app_left a b c : disjoint (a ++ b) c <-> disjoint a c /\ disjoint b c.
  Proof.
    unfold disjoint. setoid_rewrite in_app_iff. split; [intros H; split; intros i Hi; apply H; auto|].
    intros [H1 H2] i [Hi | Hi]; auto.
  Qed.

  Lemma disjoint_app_right a b c : disjoint a (b ++ c) <-> disjoint a b /\ disjoint a c.
  Proof.
    unfold disjoint. setoid_rewrite in_app_iff. split; [intros H; split; intros i Hi Hj; apply (H i Hi); auto|].
    intros [H1 H2] i Hi [Hj | Hj]; [apply (H1 i Hi) | apply (H2 i Hi)]; exact Hj.
  Qed.

  Lemma disjoint_sym a b : disjoint a b -> disjoint b a.
  Proof. intros H i Hi Hj. exact (H i Hj Hi). Qed.

  Lemma separate_app a b : separate (a ++ b) <-> separate a /\ separate b /\ disjoint (concat a) (concat b).
  Proof.
    induction a as [|x a IH]; cbn [app separate concat].
    - split; [intros H; repeat split; auto; intros i [] | tauto].
    - rewrite IH, concat_app, disjoint_app_right, disjoint_app_left. tauto.
  Qed.

  Lemma separate_middle a x b : separate (a ++ x :: b) <-> separate (x :: a ++ b).
  Proof.
    cbn [separate]. rewrite !separate_app, concat_app, disjoint_app_right. cbn [separate concat].
    rewrite disjoint_app_right. split.
    - intros (H1 & (H2 & H3) & H4 & H5). auto using disjoint_sym.
    - intros ((H1 & H2) & H3 & H4 & H5). auto using disjoint_sym.
  Qed.

  Definition atom (r : residual) : bool :=
    match r with
    | Ready _ _ | Running _ _ | Action _ | Condition _ | Idle _ _ | Confirm _ _ _ | Made _ _ _ | Unallocated _ _
    | Recruit _ _ _ _ _ => true
    | _ => false
    end.

  Definition of_branch (b : branch) : list timer := numbers (snd b).

  Inductive Numbered : residual -> Prop :=
  | N_sequence : forall r t, Numbered r -> Numbered t -> disjoint (numbers r) (numbers t) -> Numbered (Sequence r t)
  | N_parallel : forall rs, (forall r, In r rs -> Numbered r) -> separate (map numbers rs) -> Numbered (Parallel rs)
  | N_branch : forall r bs, Numbered r -> (forall b, In b bs -> Numbered (snd b)) ->
      separate (numbers r :: map of_branch bs) -> Numbered (Branch r bs)
  | N_all_of : forall bs, (forall b, In b bs -> Numbered (snd b)) -> separate (map of_branch bs) -> Numbered (All_of bs)
  | N_one_of : forall bs, (forall b, In b bs -> Numbered (snd b)) -> separate (map of_branch bs) -> Numbered (One_of bs)
  | N_until : forall k g r, Numbered r -> Numbered (Until k g r)
  | N_during : forall k i n r, Numbered r -> ~ In i (numbers r) -> Numbered (During k i n r)
  | N_during_code : forall k i d r, Numbered r -> ~ In i (numbers r) -> Numbered (During_code k i d r)
  | N_watch : forall r h, Numbered r -> Numbered (Watch r h)
  | N_repeat : forall r more g t, Numbered r -> Numbered t -> Numbered (Repeat r more g t)
  | N_asked : forall more g t, Numbered t -> Numbered (Asked more g t)
  | N_holding : forall vs r, Numbered r -> Numbered (Holding vs r)
  | N_recruited : forall v r, Numbered r -> Numbered (Recruited v r)
  | N_fresh : forall ks r, NoDup ks -> Numbered r -> disjoint ks (numbers r) -> Numbered (Fresh ks r)
  | N_ensure : forall r ds, Numbered r -> Numbered (Ensure r ds)
  | N_atom : forall r, atom r = true -> Numbered r.

  (** {1 Open waits} *)

  Lemma waits_numbers r i : In i (map fst (waits r)) -> In i (numbers r).
  Proof.
    revert i. induction r using residual_rect'; cbn [waits numbers map]; intros i0 Hi; rewrite ?in_app_iff; auto;
      try contradiction.
    - rewrite map_flat_map in Hi. apply in_flat_map in Hi. destruct Hi as (r & Hr & Hi).
      rewrite Forall_forall in H. apply in_flat_map. exists r. auto.
    - destruct Hi as [<- | Hi]; [left; reflexivity | right; auto].
  Qed.

  Lemma NoDup_app_disjoint (a b : list timer) : NoDup a -> NoDup b -> disjoint a b -> NoDup (a ++ b).
  Proof.
    induction 1 as [|i a Hi _ IH]; cbn [app]; intros Hb Hd; [exact Hb|]. constructor.
    - rewrite in_app_iff. intros [H | H]; [contradiction | apply (Hd i); [left; reflexivity | exact H]].
    - apply IH; [exact Hb|]. intros j Hj. apply Hd. right. exact Hj.
  Qed.

  Lemma numbered_distinct r : Numbered r -> distinct_waits r.
  Proof.
    unfold distinct_waits. induction 1; cbn [waits map]; auto; try (constructor; fail).
    - rewrite map_flat_map. induction rs as [|r rs IH]; cbn [flat_map]; [constructor|].
      cbn [map separate] in H1. destruct H1 as [H1 H2].
      apply NoDup_app_disjoint.
      + apply H0. left. reflexivity.
      + apply IH; auto; intros x Hx; [apply H | apply H0]; right; exact Hx.
      + intros i Hi Hj. apply (H1 i); [apply waits_numbers; exact Hi|]. apply in_flat_map in Hj.
        destruct Hj as (x & Hx & Hj). apply in_concat. exists (numbers x). split; [apply in_map; exact Hx|].
        apply waits_numbers. exact Hj.
    - constructor; [|exact IHNumbered]. intros Hi. apply waits_numbers in Hi. contradiction.
    - destruct r; cbn in H |- *; try discriminate; repeat constructor; intros [].
  Qed.

  (** {1 Normal forms} *)

  Lemma numbered_sequence a b : Numbered a -> Numbered b -> disjoint (numbers a) (numbers b) -> Numbered (sequence a b).
  Proof.
    induction 1; intros Hb Hd; cbn [sequence]; try (constructor; [constructor; assumption | exact Hb | exact Hd]; fail).
    - cbn [numbers] in Hd. apply disjoint_app_left in Hd. destruct Hd as [D1 D2]. constructor; [assumption | auto |].
      intros i Hi Hj. apply alike_numbers_sequence, in_app_iff in Hj. destruct Hj as [Hj | Hj];
        [apply (H1 i Hi) | apply (D1 i Hi)]; exact Hj.
    - destruct r; cbn in H |- *; try discriminate; (constructor; [constructor; reflexivity | exact Hb | exact Hd]).
  Qed.

  Lemma numbered_flat r : Numbered r -> (forall x, In x (flat r) -> Numbered x) /\ separate (map numbers (flat r)).
  Proof.
    intros H. destruct r; cbn [flat]; try (split; [intros ? [<- | []]; exact H | cbn; split;
      [intros ? _ [] | exact I]]; fail).
    inversion H; subst; [split; assumption | discriminate].
  Qed.

  Lemma concat_numbers rs : concat (map numbers rs) = flat_map numbers rs.
  Proof. symmetry. apply flat_map_concat_map. Qed.

  Lemma concat_branches bs : concat (map of_branch bs) = flat_map (fun b => numbers (snd b)) bs.
  Proof. symmetry. apply (flat_map_concat_map (fun b => numbers (snd b))). Qed.

  Lemma numbered_flats rs : (forall r, In r rs -> Numbered r) -> separate (map numbers rs) ->
    (forall x, In x (flat_map flat rs) -> Numbered x) /\ separate (map numbers (flat_map flat rs)).
  Proof.
    induction rs as [|r rs IH]; intros H Hs; cbn [flat_map]; [split; [intros x [] | exact I]|].
    cbn [map separate] in Hs. destruct Hs as [S1 S2].
    destruct (numbered_flat (H r (or_introl eq_refl))) as [F1 F2].
    destruct (IH (fun x Hx => H x (or_intror Hx)) S2) as [G1 G2]. split.
    - intros x Hx. apply in_app_iff in Hx. destruct Hx; auto.
    - rewrite map_app. apply separate_app. split; [exact F2 | split; [exact G2|]].
      rewrite !concat_numbers. rewrite (through_flat _ _ _ through_numbers), (through_flats _ _ _ through_numbers).
      rewrite concat_numbers in S1. exact S1.
  Qed.

  Lemma numbered_parallel rs : (forall r, In r rs -> Numbered r) -> separate (map numbers rs) -> Numbered (parallel rs).
  Proof.
    intros H Hs. destruct (numbered_flats H Hs) as [F1 F2]. unfold parallel.
    destruct (flat_map flat rs) as [|x [|y rest]]; [constructor; auto | apply F1; left; reflexivity | constructor;
      auto].
  Qed.

  Lemma numbers_parallel rs : numbers (parallel rs) = flat_map numbers rs.
  Proof. apply through_parallel, through_numbers. Qed.

  Lemma numbers_repeat r more g t i : In i (numbers (repeat_ r more g t)) -> In i (numbers r) \/ In i (numbers t).
  Proof. destruct more as [[|n]|]; cbn [repeat_ numbers]; rewrite ?in_app_iff; auto. Qed.

  Lemma numbered_repeat r more g t : Numbered r -> Numbered t -> Numbered (repeat_ r more g t).
  Proof. intros. destruct more as [[|n]|]; cbn [repeat_]; [assumption | constructor; assumption | constructor;
    assumption]. Qed.

  Lemma numbers_given ds r : numbers (given ds r) = numbers r.
  Proof.
    induction r; cbn [given]; try reflexivity; [destruct (has_parameters a); reflexivity|].
    destruct (given_back ds ds0); cbn [ensure_ numbers]; exact IHr.
  Qed.

  Lemma numbered_ensure r ds : Numbered r -> Numbered (ensure_ r ds).
  Proof. intros H. destruct ds; [exact H | constructor; exact H]. Qed.

  Lemma numbers_ensure r ds : numbers (ensure_ r ds) = numbers r.
  Proof. destruct ds; reflexivity. Qed.

  Lemma numbered_given ds r : Numbered r -> Numbered (given ds r).
  Proof.
    induction r; cbn [given]; intros H; try exact H; [destruct (has_parameters a); constructor; reflexivity|].
    apply numbered_ensure, IHr. inversion H; subst; [assumption | discriminate].
  Qed.

  (** {1 What is built} *)

  (** Later timers have other numbers. *)
  Definition increasing (p : supply) : Prop :=
    forall a b a' b', a < a' -> b <= b' -> number p a b <> number p a' b'.

  Lemma increasing_apart p a b a' b' : increasing p -> number p a b = number p a' b' ->
    ~ (a < a' /\ b <= b') /\ ~ (a' < a /\ b' <= b).
  Proof. intros Hp E. split; intros [H1 H2]; [apply (Hp a b a' b') | apply (Hp a' b' a b)]; auto. Qed.

  (** The keys of [t], which is open, are those from [n] to before [n'], each of one [fresh]. *)
  Fixpoint keyed (key : nat -> timer) (t : task) (n n' : nat) : Prop :=
    match t with
    | TPlan _ | TAction _ | TCondition _ | TIdle _ | TConfirm _ _ | TMade _ | TRecruit _ _ | TFresh _ => n <= n'
    | TSequence t1 t2 | TParallel t1 t2 => exists m, keyed key t1 n m /\ keyed key t2 m n'
    | TAllocated t _ | TUntil _ _ t | TDuring _ _ t | TWatch t _ | TRepeat _ _ t | TEnsure t _ => keyed key t n n'
    | TAll_of bs | TOne_of bs =>
        (fix branches (bs : list (code * task)) (n : nat) : Prop :=
           match bs with
           | [] => n <= n'
           | (_, t) :: bs => exists m, keyed key t n m /\ branches bs m
           end) bs n
    | TKeys ks _ t => exists m, n <= m /\ ks = map key (seq n (m - n)) /\ keyed key t m n'
    end.

  Lemma keyed_later key t : forall n n', keyed key t n n' -> n <= n'.
  Proof.
    induction t using task_rect'; cbn [keyed]; intros n0 n' K0; auto.
    - destruct K0 as (m & H1 & H2). apply IHt1 in H1. apply IHt2 in H2. lia.
    - destruct K0 as (m & H1 & H2). apply IHt1 in H1. apply IHt2 in H2. lia.
    - revert n0 K0. induction H as [|(g, t) bs Hb _ IH]; intros n0 K0; [exact K0|].
      destruct K0 as (m & H1 & H2). apply Hb in H1. apply IH in H2. lia.
    - revert n0 K0. induction H as [|(g, t) bs Hb _ IH]; intros n0 K0; [exact K0|].
      destruct K0 as (m & H1 & H2). apply Hb in H1. apply IH in H2. lia.
    - destruct K0 as (m & H1 & _ & H2). apply IHt in H2. lia.
  Qed.

  Lemma keyed_open_each key inside t :
    (forall c n t' n', inside c n = inl (t', n') -> keyed key t' n n') ->
    forall n t' n', open_each inside t n = inl (t', n') -> keyed key t' n n'.
  Proof.
    intros Hi.
    assert (Branches : forall bs,
      Forall (fun x => forall n t' n', open_each inside (snd x) n = inl (t', n') -> keyed key t' n n') bs ->
      forall n bs' n',
      (fix each (bs : list (code * task)) (n : nat) : (list (code * task) * nat) + message :=
         match bs with
         | [] => inl ([], n)
         | (g, a) :: bs =>
             match open_each inside a n with
             | inl (a', n1) => match each bs n1 with inl (bs', n2) => inl ((g, a') :: bs', n2) | inr m => inr m end
             | inr m => inr m
             end
         end) bs n = inl (bs', n') ->
      (fix branches (bs : list (code * task)) (n : nat) : Prop :=
         match bs with
         | [] => n <= n'
         | (_, t) :: bs => exists m, keyed key t n m /\ branches bs m
         end) bs' n).
    { induction 1 as [|(g, a) bs Hb _ IH]; intros n bs' n' H.
      - injection H as <- <-. apply le_n.
      - destruct (open_each inside a n) as [(a' & n1)|] eqn:A; [|discriminate].
        destruct (_ bs n1) as [(bs1 & n2)|] eqn:B; [|discriminate]. injection H as <- <-.
        exists n1. split; [apply Hb; exact A | apply IH; exact B]. }
    induction t using task_rect'; intros n0 t' n' Ho; cbn [open_each] in Ho;
      try (injection Ho as <- <-; apply le_n);
      try (apply Hi with (1 := Ho));
      try (destruct (open_each inside t n0) as [(a' & n1)|] eqn:A; [|discriminate]; injection Ho as <- <-;
           apply (IHt _ _ _ A)).
    - destruct (open_each inside t1 n0) as [(a' & n1)|] eqn:A; [|discriminate].
      destruct (open_each inside t2 n1) as [(b' & n2)|] eqn:B; [|discriminate]. injection Ho as <- <-. exists n1. eauto.
    - destruct (open_each inside t1 n0) as [(a' & n1)|] eqn:A; [|discriminate].
      destruct (open_each inside t2 n1) as [(b' & n2)|] eqn:B; [|discriminate]. injection Ho as <- <-. exists n1. eauto.
    - destruct (_ bs n0) as [(bs' & n1)|] eqn:B; [|discriminate]. injection Ho as <- <-. apply (Branches bs H _ _ _ B).
    - destruct (_ bs n0) as [(bs' & n1)|] eqn:B; [|discriminate]. injection Ho as <- <-. apply (Branches bs H _ _ _ B).
  Qed.

  Lemma keyed_opened_with fuel w h S key : forall q t n t' n',
    opened_with fuel w h S key q t n = inl (t', n') -> keyed key t' n n'.
  Proof.
    induction fuel as [|fuel IH]; intros q t n t' n'; cbn [opened_with]; apply keyed_open_each; clear t n t' n';
      intros c n t' n' H;
      destruct (run c _ w h S) as [x s N ds | m ds | m ds | m s N ds |]; try discriminate;
      destruct (made_task c _ q S x s ds) as [t1|]; try discriminate.
    destruct (opened_with fuel w h S key _ t1 _) as [(t2 & n2)|] eqn:O; [|discriminate]. injection H as <- <-.
    exists (n + parameters c). split; [lia | split].
    - replace (n + parameters c - n) with (parameters c) by lia. reflexivity.
    - eapply IH. exact O.
  Qed.

  Lemma keyed_opened w h S key q t n t' n' : opened w h S key q t n = inl (t', n') -> keyed key t' n n'.
  Proof. Transparent opened. apply keyed_opened_with. Qed.
  Opaque opened.

  (** Keys come first, from [n] to before [n']; then timers, from [a]. *)
  Definition within_numbers (p : supply) (n n' a b : nat) (ts ps : nat) (is : list timer) : Prop :=
    forall i, In i is -> exists a' b', i = number p a' b' /\
      ((n <= a' < n' /\ b' = 0) \/ (a <= a' < a + ts /\ b <= b' <= b + ps)).

  Lemma numbered_build (p : supply) t : increasing p -> forall ok n n' k a b,
    keyed (fun j => number p j 0) t n n' -> n' <= a ->
    Numbered (build p ok t k a b) /\
    within_numbers p n n' a b (timers t) (places t) (numbers (build p ok t k a b)).
  Proof.
    intros Hp.
    assert (Apart : forall n m n' a b ts ps ts' ps' is js, n <= m <= n' -> n' <= a ->
      within_numbers p n m a b ts ps is -> within_numbers p m n' (a + ts) (b + ps) ts' ps' js -> disjoint is js).
    { intros n m n' a b ts ps ts' ps' is js Hm Ha W1 W2 i Hi Hj.
      destruct (W1 i Hi) as (a1 & b1 & -> & D1). destruct (W2 _ Hj) as (a2 & b2 & E & D2).
      apply (increasing_apart Hp) in E. lia. }
    assert (Both : forall n m n' a b ts ps ts' ps' is js, n <= m <= n' ->
      within_numbers p n m a b ts ps is -> within_numbers p m n' (a + ts) (b + ps) ts' ps' js ->
      within_numbers p n n' a b (ts + ts') (ps + ps') (is ++ js)).
    { intros n m n' a b ts ps ts' ps' is js Hm W1 W2 i Hi. apply in_app_iff in Hi. destruct Hi as [Hi | Hi].
      - destruct (W1 i Hi) as (a1 & b1 & -> & D1). exists a1, b1. split; [reflexivity | lia].
      - destruct (W2 i Hi) as (a1 & b1 & -> & D1). exists a1, b1. split; [reflexivity | lia]. }
    assert (Branches : forall ok bs,
      Forall (fun x => forall ok n n' k a b, keyed (fun j => number p j 0) (snd x) n n' -> n' <= a ->
                Numbered (build p ok (snd x) k a b) /\
                within_numbers p n n' a b (timers (snd x)) (places (snd x)) (numbers (build p ok (snd x) k a b))) bs ->
      forall n n' k a b,
      (fix branches (bs : list (code * task)) (n : nat) : Prop :=
         match bs with
         | [] => n <= n'
         | (_, t) :: bs => exists m, keyed (fun j => number p j 0) t n m /\ branches bs m
         end) bs n ->
      n' <= a ->
      let rs :=
        (fix branches (bs : list (code * task)) (k a b : nat) : list branch :=
           match bs with
           | [] => []
           | (g, t) :: bs => (g, build p ok t k a b) :: branches bs (k + leaves t) (a + timers t) (b + places t)
           end) bs k a b in
      n <= n' /\ (forall b, In b rs -> Numbered (snd b)) /\ separate (map of_branch rs) /\
      within_numbers p n n' a b (list_sum (map (fun b => timers (snd b)) bs))
        (list_sum (map (fun b => places (snd b)) bs)) (concat (map of_branch rs))).
    { intros ok bs. induction 1 as [|(g, t0) bs Hb _ IH]; intros n n' k a b Hk Ha.
      - split; [exact Hk | split; [intros x [] | split; [exact I | intros i []]]].
      - destruct Hk as (m & K1 & K2). assert (Hm := keyed_later K1).
        destruct (IH m n' (k + leaves t0) (a + timers t0) (b + places t0) K2) as (I0 & I1 & I2 & I3); [lia|].
        destruct (Hb ok n m k a b K1) as [B1 B2]; [lia|]. cbn [snd] in B1, B2.
        change (list_sum (map (fun b => timers (snd b)) ((g, t0) :: bs)))
          with (timers t0 + list_sum (map (fun b => timers (snd b)) bs)).
        change (list_sum (map (fun b => places (snd b)) ((g, t0) :: bs)))
          with (places t0 + list_sum (map (fun b => places (snd b)) bs)).
        split; [lia | split; [|split]].
        + intros x [<- | Hx]; [exact B1 | apply I1; exact Hx].
        + cbn [map separate of_branch snd]. split; [|exact I2].
          eapply Apart; [split; [exact Hm | exact I0] | exact Ha | exact B2 | exact I3].
        + cbn [map concat of_branch snd]. eapply Both; [split; [exact Hm | exact I0] | exact B2 | exact I3]. }
    assert (Inner : forall n n' a b ts ps is, n' <= a -> within_numbers p n n' (Datatypes.S a) b ts ps is ->
      ~ In (number p a b) is /\ within_numbers p n n' a b (1 + ts) ps (number p a b :: is)).
    { intros n n' a b ts ps is Ha W. split.
      - intros Hi. destruct (W _ Hi) as (a1 & b1 & E & D). apply (increasing_apart Hp) in E. lia.
      - intros i [<- | Hi]; [exists a, b; split; [reflexivity | lia]|].
        destruct (W i Hi) as (a1 & b1 & -> & D). exists a1, b1. split; [reflexivity | lia]. }
    induction t using task_rect'; intros ok n0 n' k0 a0 b0 Hk Ha; cbn [build timers places keyed] in *;
      try (split; [constructor; reflexivity | intros i []]; fail);
      try (split; [constructor; reflexivity | intros i [<- | []]; exists a0, b0; split; [reflexivity | lia]]; fail).
    - destruct Hk as (m & K1 & K2). assert (M1 := keyed_later K1). assert (M2 := keyed_later K2).
      destruct (IHt1 ok n0 m k0 a0 b0 K1) as [N1 W1]; [lia|].
      destruct (IHt2 ok m n' (k0 + leaves t1) (a0 + timers t1) (b0 + places t1) K2) as [N2 W2]; [lia|].
      split.
      + apply numbered_sequence; [exact N1 | exact N2 |]. eapply Apart; [split; [exact M1 | exact M2] | exact Ha |
        exact W1 | exact W2].
      + intros i Hi. apply alike_numbers_sequence in Hi. revert i Hi.
        eapply Both; [split; [exact M1 | exact M2] | exact W1 | exact W2].
    - destruct Hk as (m & K1 & K2). assert (M1 := keyed_later K1). assert (M2 := keyed_later K2).
      destruct (IHt1 ok n0 m k0 a0 b0 K1) as [N1 W1]; [lia|].
      destruct (IHt2 ok m n' (k0 + leaves t1) (a0 + timers t1) (b0 + places t1) K2) as [N2 W2]; [lia|].
      split.
      + apply numbered_parallel; [intros x [<- | [<- | []]]; assumption|].
        cbn [map separate concat]. rewrite app_nil_r. split; [|split; [intros i _ [] | exact I]].
        eapply Apart; [split; [exact M1 | exact M2] | exact Ha | exact W1 | exact W2].
      + rewrite numbers_parallel. cbn [flat_map]. rewrite app_nil_r.
        eapply Both; [split; [exact M1 | exact M2] | exact W1 | exact W2].
    - apply IHt; assumption.
    - destruct (Branches ok bs H n0 n' k0 a0 b0 Hk Ha) as (_ & B1 & B2 & B3).
      assert (E : forall rs, numbers (all_of rs) = concat (map of_branch rs)).
      { intros rs. rewrite concat_branches. destruct rs as [|x [|y rs]]; reflexivity. }
      rewrite E. split; [|exact B3]. unfold all_of. destruct (_ bs k0 a0 b0) as [|x [|y rs]]; constructor; assumption.
    - destruct (Branches ok bs H n0 n' k0 a0 b0 Hk Ha) as (_ & B1 & B2 & B3).
      cbn [numbers]. rewrite <- concat_branches. split; [constructor; assumption | exact B3].
    - destruct (IHt ok n0 n' k0 a0 b0 Hk Ha) as [N1 W1]. split; [constructor; exact N1 | exact W1].
    - destruct d as [d | d]; destruct (IHt ok n0 n' k0 (Datatypes.S a0) b0 Hk) as [N1 W1]; try lia;
        destruct (Inner _ _ _ _ _ _ _ Ha W1) as [D W]; (split; [constructor; assumption | exact W]).
    - destruct (may_recover h).
      + destruct (IHt ok n0 n' k0 a0 (Datatypes.S b0) Hk Ha) as [N1 W1]. split; [constructor; exact N1|].
        intros i Hi. destruct (W1 i Hi) as (a1 & b1 & -> & D). exists a1, b1. split; [reflexivity | lia].
      + destruct (IHt ok n0 n' k0 a0 b0 Hk Ha) as [N1 W1]. split; [constructor; exact N1|].
        intros i Hi. destruct (W1 i Hi) as (a1 & b1 & -> & D). exists a1, b1. split; [reflexivity | lia].
    - destruct (IHt ok n0 n' k0 a0 b0 Hk Ha) as [N1 W1]. split; [apply numbered_repeat; assumption|].
      intros i Hi. apply numbers_repeat in Hi. destruct Hi as [Hi | Hi]; apply W1; exact Hi.
    - destruct Hk as (m & M1 & -> & K2). assert (M2 := keyed_later K2).
      destruct (IHt ok m n' k0 a0 b0 K2 Ha) as [N1 W1]. split.
      + constructor; [|exact N1|].
        * apply Injective_map_NoDup; [|apply seq_NoDup]. intros x y E. apply (increasing_apart Hp) in E. lia.
        * intros i Hi Hj. apply in_map_iff in Hi. destruct Hi as (j & <- & Hi). apply in_seq in Hi.
          destruct (W1 _ Hj) as (a1 & b1 & E & D). apply (increasing_apart Hp) in E. lia.
      + intros i Hi. cbn [numbers] in Hi. apply in_app_iff in Hi. destruct Hi as [Hi | Hi].
        * apply in_map_iff in Hi. destruct Hi as (j & <- & Hi). apply in_seq in Hi. exists j, 0.
          split; [reflexivity | lia].
        * destruct (W1 i Hi) as (a1 & b1 & -> & D). exists a1, b1. split; [reflexivity | lia].
    - destruct (IHt ok n0 n' k0 a0 b0 Hk Ha) as [N1 W1]. rewrite numbers_ensure. split; [|exact W1].
      apply numbered_ensure. exact N1.
  Qed.

  Lemma top_increasing f : increasing (top f).
  Proof. intros a b a' b' Ha Hb. cbn. unfold next. lia. Qed.

  Lemma fresh_above i used n : (i < fresh i used n)%N.
  Proof.
    assert (A : forall used fuel j, (j < after_ used fuel j)%N).
    { intros u fuel j. destruct (after_spec u fuel j) as (k & -> & _). unfold generation. lia. }
    induction n as [|n IH]; cbn [fresh]; [apply A|]. specialize (A used (length used) (fresh i used n)). lia.
  Qed.

  Lemma fresh_increasing i used n m : n < m -> (fresh i used n < fresh i used m)%N.
  Proof.
    assert (A : forall fuel j, (j < after_ used fuel j)%N).
    { intros fuel j. destruct (after_spec used fuel j) as (k & -> & _). unfold generation. lia. }
    induction m as [|m IH]; intros H; [lia|]. cbn [fresh]. specialize (A (length used) (fresh i used m)).
    destruct (Nat.eq_dec n m) as [->|]; [exact A|]. assert (n < m) by lia. specialize (IH H0). lia.
  Qed.

  Lemma fresh_unused i used n : ~ In (fresh i used n) used.
  Proof.
    destruct n as [|n]; cbn [fresh].
    - destruct (after_free (used := used) i (le_n _)) as (k & -> & _ & H). exact H.
    - destruct (after_free (used := used) (fresh i used n) (le_n _)) as (k & -> & _ & H). exact H.
  Qed.

  Lemma made_increasing q used f : increasing (made_at q used f).
  Proof. intros a b a' b' Ha Hb. cbn. intros E. pose proof (fresh_increasing (place q) used Ha). lia. Qed.

  (** {1 Steps} *)

  (** What is left is numbered, and new numbers are taken by nothing around. *)
  Definition keeps_numbers (K : context) (r : residual) (u : transition) : Prop :=
    match u with
    | By _ _ (Next r') _ =>
        Numbered r' /\ forall i, In i (numbers r') -> In i (numbers r) \/ ~ In i (taken_numbers K)
    | _ => True
    end.

  Ltac is_only H := cbn in H; destruct H as [H | H]; [subst | contradiction].

  Lemma coded_numbers K r e c ys S gives faulty u : In u (coded e c ys K S gives faulty) ->
    (forall x s N ds, In u (gives x s N ds) -> keeps_numbers K r u) ->
    (forall m ds, In u (faulty m ds) -> keeps_numbers K r u) -> keeps_numbers K r u.
  Proof. intros H H1 H2. eapply coded_spec; [exact H | exact H1 | exact H2 |]. intros; subst. exact I. Qed.

  Lemma guarded_numbers K r e g S holds fails faulty u : In u (guarded e g K S holds fails faulty) ->
    (forall s N ds, In u (holds s N ds) -> keeps_numbers K r u) -> (In u fails -> keeps_numbers K r u) ->
    (forall m ds, In u (faulty m ds) -> keeps_numbers K r u) -> keeps_numbers K r u.
  Proof. intros H H1 H2 H3. eapply guarded_spec; [exact H | exact H1 | exact H2 | exact H3 |]. intros;
    subst. exact I. Qed.

  Lemma chosen_branch bs b g r after : bs = b ++ (g, r) :: after ->
    (forall x, In x bs -> Numbered (snd x)) -> separate (map of_branch bs) ->
    Numbered r /\ (forall x, In x (b ++ after) -> Numbered (snd x)) /\
    separate (numbers r :: map of_branch (b ++ after)) /\
    (forall i, In i (numbers r) \/ In i (concat (map of_branch (b ++ after))) -> In i (concat (map of_branch bs))).
  Proof.
    intros -> H Hs. rewrite map_app in Hs. cbn [map] in Hs. apply separate_middle in Hs. rewrite map_app.
    split; [apply (H (g, r)); apply in_elt | split; [|split; [exact Hs|]]].
    - intros x Hx. apply H. rewrite in_app_iff in *. cbn. tauto.
    - intros i. rewrite map_app, !concat_app, !in_app_iff. cbn [map concat of_branch snd]. rewrite in_app_iff. tauto.
  Qed.

  Lemma numbered_branch_of r bs : Numbered r -> (forall x, In x bs -> Numbered (snd x)) ->
    separate (numbers r :: map of_branch bs) -> Numbered (branch_of r bs).
  Proof. intros H H1 H2. destruct bs; [exact H | constructor; assumption]. Qed.

  Lemma numbers_branch_of r bs i : In i (numbers (branch_of r bs)) ->
    In i (numbers r) \/ In i (concat (map of_branch bs)).
  Proof.
    rewrite concat_branches. destruct bs; cbn [branch_of]; [auto|]. cbn [numbers]. rewrite in_app_iff. auto.
  Qed.

  Lemma own_numbers e K S r u : Numbered r -> In u (own e K S r) -> keeps_numbers K r u.
  Proof.
    intros Hn Hu. destruct r; cbn [own] in Hu; try contradiction.
    - destruct e; [contradiction|]. is_only Hu. split; [constructor; reflexivity | intros i []].
    - destruct e as [[]|]; try contradiction; destruct (vehicle_eq v0 v); try contradiction; is_only Hu; exact I.
    - eapply coded_numbers; [exact Hu | |]; cbv beta; intros; is_only H; exact I.
    - eapply guarded_numbers; [exact Hu | | |]; cbv beta; intros; try contradiction; is_only H; exact I.
    - apply in_each in Hu. destruct Hu as (b & (g & r) & after & Hbs & Hu). cbn [app] in Hu.
      inversion Hn; subst; [|discriminate]. destruct (chosen_branch eq_refl H0 H1) as (N1 & N2 & N3 & N4).
      eapply guarded_numbers; [exact Hu | | |]; cbv beta; intros; try contradiction; is_only H; try exact I. split.
      + apply numbered_branch_of; [apply numbered_given; exact N1 | exact N2 | rewrite numbers_given; exact N3].
      + intros i Hi. left. cbn [numbers]. rewrite <- concat_branches. apply N4.
        apply numbers_branch_of in Hi. rewrite numbers_given in Hi. exact Hi.
    - apply in_each in Hu. destruct Hu as (b & (g & r) & after & Hbs & Hu). cbn [app] in Hu.
      inversion Hn; subst; [|discriminate]. destruct (chosen_branch eq_refl H0 H1) as (N1 & N2 & N3 & N4).
      eapply guarded_numbers; [exact Hu | | |]; cbv beta; intros; try contradiction; is_only H; try exact I. split.
      + apply numbered_given. exact N1.
      + intros i Hi. left. cbn [numbers]. rewrite <- concat_branches. apply N4. rewrite numbers_given in Hi. auto.
    - eapply guarded_numbers; [exact Hu | | |]; cbv beta; destruct k; intros; try contradiction; is_only H; exact I.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction]. is_only Hu. exact I.
    - destruct e as [[]|]; try contradiction; [destruct yes|]; (destruct (timer_eq i0 i); [|contradiction]);
        is_only Hu; exact I.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction]. is_only Hu.
      destruct k; exact I.
    - inversion Hn; subst; [|discriminate].
      eapply coded_numbers; [exact Hu | |]; cbv beta; intros.
      + destruct (time_of d x); is_only H; [|exact I]. split; [constructor; assumption | auto].
      + is_only H. exact I.
    - inversion Hn; subst; [|discriminate].
      eapply guarded_numbers; [exact Hu | | |]; cbv beta; intros; is_only H; try exact I. split.
      + apply numbered_repeat; assumption.
      + intros i Hi. left. apply numbers_repeat in Hi. cbn. tauto.
    - eapply coded_numbers; [exact Hu | |]; cbv beta; intros.
      + destruct (made_task a ys q S x s ds); is_only H; [|exact I]. split; [constructor; reflexivity | intros i []].
      + is_only H. exact I.
    - destruct e; [contradiction|].
      destruct (alloc_made (world_of K) (held K) S (free K S) t q (taken_numbers K)) as [(vs & r) | m] eqn:A.
      + is_only Hu. unfold alloc_made in A. destruct (opened _ _ _ _ _ _ _) as [(t' & n)|] eqn:O; [|discriminate].
        destruct (assign _ _ _ _) as [f|]; [|discriminate]. injection A as <- <-.
        assert (Inc : increasing (made_at q (taken_numbers K) f)) by apply made_increasing.
        destruct (numbered_build Inc (allowed q) 0 0 (keyed_opened O : keyed (fun j => number (made_at q
          (taken_numbers K) f) j 0) t' 0 n) (le_n _)) as [N1 N2].
        set (r := build _ _ _ _ _ _) in *.
        assert (E : numbers (holding (used_of (free K S) t' f) r) = numbers r)
          by (destruct (used_of (free K S) t' f); reflexivity).
        split; [destruct (used_of (free K S) t' f); [exact N1 | constructor; exact N1]|].
        intros i Hi. rewrite E in Hi. right. destruct (N2 i Hi) as (a & b & -> & _). apply fresh_unused.
      + destruct (alloc_made (world_of K) (held K) S (its_bound K S) t q (taken_numbers K)); [contradiction|].
        is_only Hu. exact I.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction].
      destruct (mem v (fit q (world_of K) (bound S)) && negb (named K v)); [|contradiction]. is_only Hu.
      split; [apply N_recruited, N_atom; reflexivity | intros ? []].
  Qed.

  Lemma numbered_part f r : Numbered (plug f r) -> Numbered r.
  Proof.
    destruct f; cbn [plug]; intros H; inversion H; subst; try discriminate; try assumption.
    match goal with H : forall r, In r _ -> Numbered r |- _ => apply H, in_elt end.
  Qed.

  (** New numbers of a part are not those of its frame. *)
  Lemma apart_from_frame f K r r' ns : disjoint (numbers r) ns -> incl ns (frame_numbers f) ->
    (forall i, In i (numbers r') -> In i (numbers r) \/ ~ In i (taken_numbers (enter f K))) -> disjoint (numbers r') ns.
  Proof.
    intros Hd Hi H i Hin Hns. destruct (H i Hin) as [Hr | Hr]; [exact (Hd i Hr Hns)|].
    apply Hr. cbn. apply in_app_iff. right. apply Hi. exact Hns.
  Qed.

  Lemma lift_numbers f K r u u' : Numbered (plug f r) -> keeps_numbers (enter f K) r u -> In u' (lift f K u) ->
    keeps_numbers K (plug f r) u'.
  Proof.
    intros Hn Hk Hu. destruct u as [l S1 o E]. destruct o as [r' | | m | x].
    - destruct Hu as [<- | []]. destruct Hk as [Hn' Hi]. cbn [keeps_numbers].
      assert (New : forall i, In i (numbers r') -> In i (numbers r) \/ ~ In i (taken_numbers K)).
      { intros i Hin. destruct (Hi i Hin) as [H | H]; [auto | right]. intros H1. apply H. cbn. apply in_app_iff. auto. }
      destruct f; cbn [plug replug] in *; inversion Hn; subst; try discriminate.
      + split.
        * apply numbered_sequence; auto. eapply (apart_from_frame (f := In_sequence t));
          [eassumption | apply incl_refl | exact Hi].
        * intros i H. apply alike_numbers_sequence, in_app_iff in H. cbn [numbers]. rewrite in_app_iff.
          destruct H as [H | H]; [destruct (New i H); auto | auto].
      + match goal with H : separate _ |- _ => rename H into Hs end.
        match goal with H : forall r, In r _ -> Numbered r |- _ => rename H into Ha end.
        rewrite map_app in Hs. cbn [map] in Hs. apply separate_middle in Hs. cbn [separate] in Hs.
          destruct Hs as [S1' S2'].
        assert (Hd : disjoint (numbers r') (concat (map numbers before ++ map numbers after))).
        { rewrite <- map_app, concat_numbers. rewrite <- map_app, concat_numbers in S1'.
          eapply (apart_from_frame (f := Beside before after)); [exact S1' | apply incl_refl | exact Hi]. }
        destruct (numbered_flat Hn') as [F1 F2]. split.
        * constructor.
          -- intros x Hx. rewrite !in_app_iff in Hx. destruct Hx as [Hx | [Hx | Hx]]; [|apply F1; exact Hx|];
               apply Ha; rewrite in_app_iff; cbn; auto.
          -- rewrite !map_app. apply separate_app in S2'. destruct S2' as (S3 & S4 & S5).
             rewrite concat_app in Hd. apply disjoint_app_right in Hd. destruct Hd as [D1 D2].
             assert (Ef : concat (map numbers (flat r')) = numbers r')
               by (rewrite concat_numbers; apply through_flat, through_numbers).
             apply separate_app. split; [exact S3 | split].
             ++ apply separate_app. rewrite Ef. auto.
             ++ rewrite concat_app, Ef. apply disjoint_app_right. auto using disjoint_sym.
        * intros i H. cbn [numbers] in *. rewrite !flat_map_app, !in_app_iff in H.
          rewrite (through_flat _ _ _ through_numbers) in H. rewrite flat_map_app. cbn [flat_map]. rewrite !in_app_iff.
          destruct H as [H | [H | H]]; auto. destruct (New i H); auto.
      + match goal with H : separate _ |- _ => destruct H as [S1' S2'] end. split.
        * constructor; auto. split; [|exact S2'].
          eapply (apart_from_frame (f := Branch_of bs)); [exact S1' | rewrite concat_branches;
            apply incl_refl | exact Hi].
        * intros i H. cbn [numbers] in *. rewrite in_app_iff in *. destruct H as [H | H]; auto. destruct (New i H);
          auto.
      + split; [constructor; exact Hn' | exact New].
      + split.
        * constructor; [exact Hn'|]. intros Hj. destruct (Hi _ Hj) as [Hj1 | Hj1]; [contradiction|].
          apply Hj1. cbn. apply in_app_iff. right. left. reflexivity.
        * intros j [<- | H]; [left; left; reflexivity | destruct (New j H); [left; right | right]; assumption].
      + split; [constructor; exact Hn' | exact New].
      + split; [constructor; assumption|]. intros i H. cbn [numbers] in *. rewrite in_app_iff in *.
        destruct H as [H | H]; auto. destruct (New i H); auto.
      + split; [constructor; exact Hn' | exact New].
      + split; [constructor; exact Hn' | exact New].
      + split.
        * constructor; auto. apply disjoint_sym. eapply (apart_from_frame (f := With_keys ks));
            [apply disjoint_sym; eassumption | apply incl_refl | exact Hi].
        * intros i H. cbn [numbers] in *. rewrite in_app_iff in *. destruct H as [H | H]; auto. destruct (New i H);
          auto.
      + split; [constructor; exact Hn' | exact New].
    - destruct Hu as [<- | []]. destruct f; cbn [plug on_ok keeps_numbers] in *; try exact I; inversion Hn; subst;
        try discriminate.
      + split; [assumption|]. intros i H. left. cbn. apply in_app_iff. auto.
      + match goal with H : separate _ |- _ => rename H into Hs end.
        rewrite map_app in Hs. cbn [map] in Hs. apply separate_middle in Hs. destruct Hs as [_ Hs]. split.
        * apply numbered_parallel; [|rewrite map_app; exact Hs]. intros x Hx.
          match goal with H : forall r, In r _ -> Numbered r |- _ => apply H end. rewrite in_app_iff in *. cbn. tauto.
        * intros i H. left. rewrite numbers_parallel, flat_map_app, in_app_iff in H. cbn [numbers].
          rewrite flat_map_app. cbn [flat_map]. rewrite !in_app_iff. tauto.
      + match goal with H : separate _ |- _ => destruct H as [_ Hs] end. split.
        * unfold all_of. destruct bs as [|x [|y bs]]; constructor; assumption.
        * intros i H. left. cbn. apply in_app_iff. right. destruct bs as [|x [|y bs]]; exact H.
      + destruct g as [g|]; cbn [keeps_numbers]; (split; [|intros i H; left; cbn; apply in_app_iff; right]).
        * constructor. assumption.
        * exact H.
        * apply numbered_repeat; assumption.
        * apply numbers_repeat in H. tauto.
    - destruct f; cbn [lift on_err] in Hu; try (destruct Hu as [<- | []]; exact I).
      unfold on_error in Hu.
      destruct (handles_error (handles h) m K S1) as [y s gone N0 ds | m' ds | m' ds | m' s gone N0 ds |];
        try contradiction; try (destruct Hu as [<- | []]; exact I).
      destruct y; [ | | destruct (anew h) as [(t0 & q)|] | destruct (anew h) as [(t0 & q)|];
        [destruct (deepest <=? depth q)|]];
        destruct Hu as [<- | []]; try exact I; (split; [repeat constructor | intros i []]).
    - destruct Hu as [<- | []]. exact I.
  Qed.

  Lemma goes_numbers x K S r u : goes x K S r u -> Numbered r -> keeps_numbers K r u.
  Proof.
    induction 1 as [K S r u H | K S f r u u' _ IH Hl]; intros Hn; [eapply own_numbers; eassumption|].
    eapply lift_numbers; [exact Hn | apply IH; eapply numbered_part; exact Hn | exact Hl].
  Qed.

  Theorem always_numbered M s N c : reachable M s N c -> forall M1 r, control_of c = Exec M1 r -> Numbered r.
  Proof.
    induction 1 as [|w x c l c' E R IH Hs]; intros M1 r Hr; [discriminate|].
    destruct Hs; cbn in Hr; try discriminate; try (eapply IH; exact Hr; fail).
    - injection Hr as -> ->. unfold alloc in H0. destruct (opened _ _ _ _ _ _ _) as [(t' & n)|] eqn:O; [|discriminate].
      destruct (assign _ _ _ _) as [f|]; [|discriminate]. injection H0 as <-. apply keyed_opened in O.
      exact (proj1 (numbered_build (top_increasing (f := f)) None 0 0 O (le_n n))).
    - injection Hr as -> ->. apply step_goes in H. apply (goes_numbers H). eapply IH. reflexivity.
  Qed.

  (** On every run, whatever is set, put or started is closed once, or open still. *)
  Theorem waits_end_once M s N h c t :
    history (initial M s N) h c ->
    cnt t (all_opened h) = cnt t (all_closed h) + cnt t (all_ended h) + cnt t (open_tokens c) /\
    cnt t (open_tokens c) <= 1.
  Proof.
    intros H. assert (R := history_reachable H). split.
    - apply (opened_is_closed_once H). intros c1 M1 r R1 Hc. right. apply numbered_distinct. eapply always_numbered;
      eassumption.
    - destruct t as [i | i | v]; [| | apply (plans_end_once v H)].
      all: destruct c as [[M1 | M1 q | M1 r | y] S]; cbn [open_tokens control_of]; rewrite ?cnt_nil; try lia;
        try (destruct q; rewrite ?cnt_nil, ?cnt_one; try lia; destruct (token_eq _ _); lia).
      all: assert (D := numbered_distinct (always_numbered R eq_refl)); assert (O := one_number i D);
        unfold tokens; rewrite cnt_app, cnt_plans_no by discriminate; lia.
  Qed.
End Numbers.
