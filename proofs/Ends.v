(** What ends of tasks owe: a pair that [using] takes is given back by the step that ends its task, whichever it is. *)
From Dolphin Require Export Normal_forms.
Set Implicit Arguments.
Unset Strict Implicit.

Section Ends.
  Context {L : Names} {C : Code}.

  (** The deeds that are counted, such as the posts of pairs of one key, and how many of their traces S has. *)
  Variables (counted : end_deed -> bool) (level : shared -> nat).

  Definition owed (ds : list end_deed) : nat := length (List.filter counted ds).
  Definition taken_by (ds : list deed) : nat := owed (map (fun x => Posts (fst x) (snd x)) (taken_pairs ds)).

  Hypothesis level_done : forall d S, level (does [d] S) = level S + if counted d then 1 else 0.
  Hypothesis level_allocation : forall A S, level (with_allocation A S) = level S.
  Hypothesis level_bound : forall B S, level (with_bound B S) = level S.
  Hypothesis level_clear : forall ks S, level S <= level (clear ks S).

  (** Code takes what its deeds say; code that is frugal, and handlers, take nothing. *)
  Variable frugal : code -> bool.
  Hypothesis code_takes : forall c ys w held S x s N ds,
    run c ys w held S = Gives x s N ds -> level S <= level (with_code s N S) + taken_by ds.
  Hypothesis frugal_code : forall c ys w held S x s N ds,
    frugal c = true -> run c ys w held S = Gives x s N ds -> level S <= level (with_code s N S).
  Hypothesis frugal_handlers : forall h m w held needed S x s gone N ds,
    run_handler h m w held needed S = Rules x s gone N ds -> level S <= level (with_code s N S).

  (** Only guards of branches take pairs, and the ends of their branches give them back: as [using] is written. *)
  Definition is_give_back (d : end_deed) : bool := match d with Gives_back => true | _ => false end.
  Definition pays (r : residual) : bool := match r with Ensure _ es => existsb is_give_back es | _ => false end.

  Fixpoint pays_task (t : task) : bool :=
    match t with TEnsure _ es => existsb is_give_back es | TAllocated t _ => pays_task t | _ => false end.

  Definition if_any (g : option code) : bool := match g with Some g => frugal g | None => true end.

  Fixpoint thrifty_task (t : task) : bool :=
    match t with
    | TPlan _ | TIdle _ | TConfirm _ _ | TMade _ | TRecruit _ _ | TFresh _ => true
    | TAction a | TCondition a => frugal a
    | TSequence a b | TParallel a b => thrifty_task a && thrifty_task b
    | TAllocated a _ | TWatch a _ | TKeys _ _ a | TEnsure a _ | TDuring _ (Seconds _) a => thrifty_task a
    | TUntil _ g a | TDuring _ (Given_by g) a => frugal g && thrifty_task a
    | TRepeat _ g a => if_any g && thrifty_task a
    | TAll_of bs | TOne_of bs => forallb (fun b => (frugal (fst b) || pays_task (snd b)) && thrifty_task (snd b)) bs
    end.

  Definition thrifty_handler (h : handler) : bool :=
    match anew h with Some (t, _) => thrifty_task t | None => true end.

  Fixpoint thrifty (r : residual) : bool :=
    match r with
    | Ready _ _ | Running _ _ | Idle _ _ | Confirm _ _ _ | Made _ _ _ | Recruit _ _ _ _ _ => true
    | Action a | Condition a => frugal a
    | Sequence r t => thrifty r && thrifty t
    | Parallel rs => forallb thrifty rs
    | Branch r bs => thrifty r && forallb (fun b => (frugal (fst b) || pays (snd b)) && thrifty (snd b)) bs
    | All_of bs | One_of bs => forallb (fun b => (frugal (fst b) || pays (snd b)) && thrifty (snd b)) bs
    | Until _ g r | During_code _ _ g r => frugal g && thrifty r
    | During _ _ _ r | Holding _ r | Recruited _ r | Fresh _ r | Ensure r _ => thrifty r
    | Watch r h => thrifty r && thrifty_handler h
    | Repeat r _ g t => thrifty r && if_any g && thrifty t
    | Asked _ g t => frugal g && thrifty t
    | Unallocated t _ => thrifty_task t
    end.

  Hypothesis task_thrifty : forall x t, task_of x = Some t -> thrifty_task t = true.
  Hypothesis handler_task_thrifty : forall h m w held needed S t s gone N ds,
    run_handler h m w held needed S = Rules (Instead t) s gone N ds -> thrifty_task t = true.

  Ltac bools := repeat rewrite andb_true_iff in *.

  Definition branches_thrifty (bs : list branch) : bool :=
    forallb (fun b => (frugal (fst b) || pays (snd b)) && thrifty (snd b)) bs.

  (** {1 Counting} *)

  Lemma owed_app a b : owed (a ++ b) = owed a + owed b.
  Proof. unfold owed. rewrite filter_app, app_length. reflexivity. Qed.

  Lemma owed_none : owed [] = 0.
  Proof. reflexivity. Qed.

  Lemma level_does ds : forall S, level (does ds S) = level S + owed ds.
  Proof.
    induction ds as [|d ds IH]; intros S.
    - change (does [] S) with {| variables := variables S; allocation := allocation S; bound := bound S;
        space := space S |}. destruct S. cbn. lia.
    - change (does (d :: ds) S) with (does ds (does [d] S)). rewrite IH, level_done. unfold owed. cbn [List.filter].
      destruct (counted d); cbn [length]; lia.
  Qed.

  Lemma level_without vs S : level (without vs S) = level S.
  Proof. apply level_allocation. Qed.

  Lemma ensured_ensure r ds : ensured (ensure_ r ds) = ensured r ++ ds.
  Proof. destruct ds; cbn; rewrite ?app_nil_r; reflexivity. Qed.

  Lemma owed_given_back ds es : existsb is_give_back es = true -> taken_by ds <= owed (given_back ds es).
  Proof.
    induction es as [|e es IH]; [discriminate|]. cbn [existsb]. unfold given_back in *. cbn [flat_map].
    rewrite owed_app. destruct e; cbn [is_give_back orb]; intros H; try (specialize (IH H); lia).
    unfold taken_by. lia.
  Qed.

  Lemma pays_given ds r : pays r = true -> taken_by ds <= owed (ensured (given ds r)).
  Proof.
    destruct r; try discriminate. cbn [pays given]. intros H. rewrite ensured_ensure, owed_app.
    apply (owed_given_back ds) in H. lia.
  Qed.

  (** {1 Residuals} *)

  Lemma thrifty_sequence r t : thrifty r = true -> thrifty t = true -> thrifty (sequence r t) = true.
  Proof.
    revert t. induction r; intros t0 Hr Ht; cbn [sequence thrifty] in *; bools; try tauto.
    destruct Hr as [H1 H2]. auto.
  Qed.

  Lemma thrifty_flat r : forallb thrifty (flat r) = thrifty r.
  Proof. destruct r; cbn [flat forallb]; rewrite ?andb_true_r; reflexivity. Qed.

  Lemma thrifty_parallel rs : forallb thrifty rs = true -> thrifty (parallel rs) = true.
  Proof.
    intros H. assert (F : forallb thrifty (flat_map flat rs) = true).
    { induction rs as [|r rs IH]; [reflexivity|]. cbn [forallb flat_map] in *. bools. rewrite forallb_app, thrifty_flat.
      bools. tauto. }
    unfold parallel. destruct (flat_map flat rs) as [|x [|y zs]]; try exact F. cbn [forallb] in F. bools. tauto.
  Qed.

  Lemma thrifty_all_of bs : branches_thrifty bs = true -> thrifty (all_of bs) = true.
  Proof. intros H. destruct bs as [|x [|y bs]]; exact H. Qed.

  Lemma thrifty_branch_of r bs : thrifty r = true -> branches_thrifty bs = true -> thrifty (branch_of r bs) = true.
  Proof. intros H1 H2. destruct bs; [exact H1|]. cbn [branch_of thrifty]. bools. auto. Qed.

  Lemma thrifty_repeat r more g t : thrifty r = true -> if_any g = true -> thrifty t = true ->
    thrifty (repeat_ r more g t) = true.
  Proof. intros H1 H2 H3. destruct more as [[|n]|]; cbn [repeat_ thrifty]; bools; auto. Qed.

  Lemma thrifty_ensure r ds : thrifty r = true -> thrifty (ensure_ r ds) = true.
  Proof. intros H. destruct ds; exact H. Qed.

  Lemma thrifty_given ds r : thrifty r = true -> thrifty (given ds r) = true.
  Proof.
    induction r; cbn [given]; auto; [destruct (has_parameters a); auto|]. intros H. apply thrifty_ensure, IHr, H.
  Qed.

  Lemma thrifty_unopened t : (pays_task t = true -> pays_task (unopened t) = true) /\
    (thrifty_task t = true -> thrifty_task (unopened t) = true).
  Proof.
    induction t using task_rect'; cbn [unopened pays_task thrifty_task]; try (split; auto; fail);
      try (destruct d); bools; try (split; [first [discriminate | tauto] | tauto]).
    - split; [discriminate|]. rewrite !forallb_forall. rewrite Forall_forall in H. intros Hb b Hin.
      apply in_map_iff in Hin. destruct Hin as (b0 & <- & Hin). cbn [fst snd]. specialize (Hb b0 Hin).
      destruct (H b0 Hin) as [H1 H2]. rewrite !andb_true_iff, !orb_true_iff in *. intuition.
    - split; [discriminate|]. rewrite !forallb_forall. rewrite Forall_forall in H. intros Hb b Hin.
      apply in_map_iff in Hin. destruct Hin as (b0 & <- & Hin). cbn [fst snd]. specialize (Hb b0 Hin).
      destruct (H b0 Hin) as [H1 H2]. rewrite !andb_true_iff, !orb_true_iff in *. intuition.
  Qed.

  Lemma pays_build (p : supply) t : forall ok k a b, pays_task t = true -> pays (build p ok t k a b) = true.
  Proof.
    induction t using task_rect'; cbn [pays_task build]; intros ok k0 a0 b0 Ht; try discriminate.
    - apply IHt. exact Ht.
    - destruct ds; [discriminate | exact Ht].
  Qed.

  Lemma thrifty_build (p : supply) t : forall ok k a b, thrifty_task t = true -> thrifty (build p ok t k a b) = true.
  Proof.
    assert (Branches : forall ok bs,
      Forall (fun x => forall ok k a b, thrifty_task (snd x) = true -> thrifty (build p ok (snd x) k a b) = true) bs ->
      forallb (fun b => (frugal (fst b) || pays_task (snd b)) && thrifty_task (snd b)) bs = true -> forall k a b,
      branches_thrifty
        ((fix branches (bs : list (code * task)) (k a b : nat) : list branch :=
           match bs with
           | [] => []
           | (g, t) :: bs => (g, build p ok t k a b) :: branches bs (k + leaves t) (a + timers t) (b + places t)
           end) bs k a b) = true).
    { intros ok bs. induction 1 as [|(g, t0) bs Hb _ IH]; intros Ht k a b; [reflexivity|].
      unfold branches_thrifty in *. cbn [forallb fst snd] in *. bools. rewrite orb_true_iff in *.
      destruct Ht as [[H1 H2] H3]. split; [split; [|apply Hb; exact H2] | apply IH; exact H3].
      destruct H1 as [H1 | H1]; [left; exact H1 | right; apply pays_build; exact H1]. }
    induction t using task_rect'; intros ok k0 a0 b0 Ht; cbn [build thrifty_task] in *; try exact Ht; try reflexivity;
      bools.
    - apply thrifty_sequence; [apply IHt1 | apply IHt2]; tauto.
    - apply thrifty_parallel. cbn [forallb]. rewrite IHt1, IHt2 by tauto. reflexivity.
    - apply IHt. exact Ht.
    - apply thrifty_all_of, Branches; assumption.
    - apply (Branches ok bs H Ht).
    - cbn [thrifty]. bools. split; [tauto | apply IHt; tauto].
    - destruct d; cbn [thrifty]; bools; [apply IHt; exact Ht | split; [tauto | apply IHt; tauto]].
    - destruct (may_recover h); cbn [thrifty]; unfold thrifty_handler; cbn [anew]; bools; split; auto.
      apply thrifty_unopened. exact Ht.
    - destruct Ht as [H1 H2]. apply thrifty_repeat; auto.
    - apply IHt. exact Ht.
    - apply thrifty_ensure, IHt. exact Ht.
  Qed.

  Lemma thrifty_open_each inside t :
    (forall c n t' n', inside c n = inl (t', n') -> thrifty_task t' = true) ->
    forall n t' n', open_each inside t n = inl (t', n') ->
      (pays_task t = true -> pays_task t' = true) /\ (thrifty_task t = true -> thrifty_task t' = true).
  Proof.
    intros Hi.
    assert (Branches : forall bs,
      Forall (fun x => forall n t' n', open_each inside (snd x) n = inl (t', n') ->
        (pays_task (snd x) = true -> pays_task t' = true) /\
        (thrifty_task (snd x) = true -> thrifty_task t' = true)) bs ->
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
      forallb (fun b => (frugal (fst b) || pays_task (snd b)) && thrifty_task (snd b)) bs = true ->
      forallb (fun b => (frugal (fst b) || pays_task (snd b)) && thrifty_task (snd b)) bs' = true).
    { induction 1 as [|(g, a) bs Hb _ IH]; intros n bs' n' H.
      - injection H as <- <-. auto.
      - cbn [forallb fst snd] in *. destruct (open_each inside a n) as [(a' & n1)|] eqn:A; [|discriminate].
        destruct (_ bs n1) as [(bs1 & n2)|] eqn:B; [|discriminate]. injection H as <- <-. cbn [forallb fst snd].
        destruct (Hb _ _ _ A) as [P T]. bools. rewrite !orb_true_iff. intros [[H1 H2] H3].
        split; [split; [tauto | auto] | eapply IH; [exact B | exact H3]]. }
    induction t using task_rect'; intros n0 t' n' Ho; cbn [open_each] in Ho;
      try (injection Ho as <- <-; auto; fail);
      try (apply Hi in Ho; split; [discriminate | auto]; fail);
      try (destruct (open_each inside t n0) as [(a' & n1)|] eqn:A; [|discriminate]; injection Ho as <- <-;
           destruct (IHt _ _ _ A) as [P T]; cbn [pays_task thrifty_task]; try (destruct d); bools;
           split; try tauto; auto; discriminate).
    - destruct (open_each inside t1 n0) as [(a' & n1)|] eqn:A; [|discriminate].
      destruct (open_each inside t2 n1) as [(b' & n2)|] eqn:B; [|discriminate]. injection Ho as <- <-.
      destruct (IHt1 _ _ _ A), (IHt2 _ _ _ B). cbn [pays_task thrifty_task]. bools. split; [discriminate | tauto].
    - destruct (open_each inside t1 n0) as [(a' & n1)|] eqn:A; [|discriminate].
      destruct (open_each inside t2 n1) as [(b' & n2)|] eqn:B; [|discriminate]. injection Ho as <- <-.
      destruct (IHt1 _ _ _ A), (IHt2 _ _ _ B). cbn [pays_task thrifty_task]. bools. split; [discriminate | tauto].
    - destruct (_ bs n0) as [(bs' & n1)|] eqn:B; [|discriminate]. injection Ho as <- <-.
      split; [discriminate | exact (Branches bs H _ _ _ B)].
    - destruct (_ bs n0) as [(bs' & n1)|] eqn:B; [|discriminate]. injection Ho as <- <-.
      split; [discriminate | exact (Branches bs H _ _ _ B)].
  Qed.

  Lemma thrifty_open_each_task inside t :
    (forall c n t' n', inside c n = inl (t', n') -> thrifty_task t' = true) ->
    forall n t' n', open_each inside t n = inl (t', n') -> thrifty_task t = true -> thrifty_task t' = true.
  Proof. intros Hi n t' n' Ho. apply (thrifty_open_each Hi Ho). Qed.

  Lemma thrifty_made a ys q S x s ds t : made_task a ys q S x s ds = Some t -> thrifty_task t = true.
  Proof.
    unfold made_task. intros M. destruct (negb (takes a ys)); [discriminate|].
    destruct (deepest <=? depth q); [discriminate|]. destruct ds; [|discriminate].
    destruct (store_eq s (variables S)); [|discriminate]. eapply task_thrifty. exact M.
  Qed.

  Lemma thrifty_opened_with fuel w h S key : forall q t n t' n',
    opened_with fuel w h S key q t n = inl (t', n') -> thrifty_task t = true -> thrifty_task t' = true.
  Proof.
    induction fuel as [|fuel IH]; intros q t n t' n'; cbn [opened_with]; apply thrifty_open_each_task;
      clear t n t' n'; intros c n t' n' H;
      destruct (run c _ w h S) as [x s N ds | m ds | m ds | m s N ds |]; try discriminate;
      destruct (made_task c _ q S x s ds) as [t1|] eqn:M; try discriminate.
    destruct (opened_with fuel w h S key _ t1 _) as [(t2 & n2)|] eqn:O; [|discriminate]. injection H as <- <-.
    cbn [thrifty_task]. eapply IH; [exact O | eapply thrifty_made; exact M].
  Qed.

  Lemma thrifty_opened w h S key q t n t' n' :
    opened w h S key q t n = inl (t', n') -> thrifty_task t = true -> thrifty_task t' = true.
  Proof. Transparent opened. apply thrifty_opened_with. Qed.
  Opaque opened.

  (** {1 Steps} *)

  (** What is owed stays owed, or is there. *)
  Definition pays_back (S : shared) (r : residual) (t : transition) : Prop :=
    match t with
    | By _ S1 (Next r') _ => thrifty r' = true /\ level S + owed (ensured r) <= level S1 + owed (ensured r')
    | By _ S1 Ok _ | By _ S1 (Err _) _ => level S + owed (ensured r) <= level S1
    | By _ _ (Ends _) _ => True
    end.

  Ltac is_only H := cbn in H; destruct H as [H | H]; [subst | contradiction].

  Lemma coded_pays e c ys K S gives faulty r t : In t (coded e c ys K S gives faulty) ->
    (forall x s N ds, runs c ys K S = Gives x s N ds -> In t (gives x s N ds) -> pays_back S r t) ->
    (forall m ds, In t (faulty m ds) -> pays_back S r t) -> pays_back S r t.
  Proof.
    unfold coded. intros H H1 H2. destruct e; [contradiction|].
    destruct (runs c ys K S) as [x s N ds | m ds | m ds | m s N ds |] eqn:R; try contradiction.
    - eapply H1; [reflexivity | exact H].
    - eapply H2. exact H.
    - is_only H. exact I.
    - is_only H. exact I.
  Qed.

  Lemma guarded_pays e g K S holds fails faulty r t : In t (guarded e g K S holds fails faulty) ->
    (forall x s N ds, runs g [] K S = Gives x s N ds -> In t (holds s N ds) -> pays_back S r t) ->
    (In t fails -> pays_back S r t) ->
    (forall m ds, In t (faulty m ds) -> pays_back S r t) -> pays_back S r t.
  Proof.
    unfold guarded. intros H H1 H2 H3. eapply coded_pays; [exact H | |]; cbv beta.
    - intros x s N ds R Hin. destruct (truth x) as [[]|]; eauto; contradiction.
    - intros m ds Hin. destruct (is_unknown m); [contradiction | eauto].
  Qed.

  (** The guard of a chosen branch. *)
  Lemma chosen_pays bs b g r after K S x s N ds : bs = b ++ (g, r) :: after -> branches_thrifty bs = true ->
    runs g [] K S = Gives x s N ds ->
    thrifty (given ds r) = true /\ branches_thrifty (b ++ after) = true /\
    level S <= level (with_code s N S) + owed (ensured (given ds r)).
  Proof.
    intros -> H R. unfold branches_thrifty in *. rewrite forallb_app in *. cbn [forallb fst snd] in H. bools.
    rewrite orb_true_iff in H. destruct H as (H1 & (H2 & H3) & H4).
    split; [apply thrifty_given; exact H3 | split; [auto|]]. destruct H2 as [H2 | H2].
    - assert (F := frugal_code H2 R). lia.
    - assert (F := code_takes R). assert (P := pays_given ds H2). lia.
  Qed.

  Lemma own_pays e K S r t : thrifty r = true -> In t (own e K S r) -> pays_back S r t.
  Proof.
    intros Hr Ht. destruct r; cbn [own] in Ht; try contradiction.
    - destruct e; [contradiction|]. is_only Ht. split; [reflexivity|]. cbn [ensured]. unfold start_on.
      rewrite level_allocation. lia.
    - destruct e as [[]|]; try contradiction; destruct (vehicle_eq v0 v); try contradiction; is_only Ht;
        cbn [pays_back ensured]; rewrite level_without; cbn; lia.
    - eapply coded_pays; [exact Ht | |]; cbv beta; intros.
      + is_only H0. assert (F := frugal_code Hr H). cbn. lia.
      + is_only H. cbn. lia.
    - eapply guarded_pays; [exact Ht | | |]; cbv beta; intros; try contradiction.
      + is_only H0. assert (F := frugal_code Hr H). cbn. lia.
      + is_only H. cbn. lia.
    - apply in_each in Ht. destruct Ht as (b & (g & r) & after & Hbs & Ht). cbn [app] in Ht.
      eapply guarded_pays; [exact Ht | | |]; cbv beta; intros; try contradiction.
      + destruct (chosen_pays Hbs Hr H) as (T1 & T2 & T3). is_only H0.
        assert (Q := level_clear (keys r) (with_code s N S)).
        split; [apply thrifty_branch_of; assumption|]. rewrite ensured_branch_of. cbn [ensured]. cbn [fst snd] in *.
        cbn. lia.
      + is_only H. cbn. lia.
    - apply in_each in Ht. destruct Ht as (b & (g & r) & after & Hbs & Ht). cbn [app] in Ht.
      eapply guarded_pays; [exact Ht | | |]; cbv beta; intros; try contradiction.
      + destruct (chosen_pays Hbs Hr H) as (T1 & T2 & T3). is_only H0.
        assert (Q := level_clear (keys r) (with_code s N S)).
        split; [exact T1|]. cbn [fst snd] in *. cbn [ensured]. cbn. lia.
      + is_only H. cbn. lia.
    - cbn [thrifty] in Hr. bools. destruct Hr as [Hg Hr].
      eapply guarded_pays; [exact Ht | | |]; cbv beta; intros.
      + destruct k; [|contradiction]. is_only H0. assert (F := frugal_code Hg H). cbn [pays_back ensured].
        rewrite level_does, level_without. lia.
      + destruct k; [contradiction|]. is_only H. cbn [pays_back ensured]. rewrite level_does, level_without. lia.
      + is_only H. cbn [pays_back ensured]. rewrite level_does, level_without. lia.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction]. is_only Ht. cbn. lia.
    - destruct e as [[]|]; try contradiction; [destruct yes|]; (destruct (timer_eq i0 i); [|contradiction]);
        is_only Ht; cbn; lia.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction]. is_only Ht.
      destruct k; cbn [time_out pays_back ensured]; rewrite level_does, level_without; lia.
    - cbn [thrifty] in Hr. bools. destruct Hr as [Hg Hr].
      eapply coded_pays; [exact Ht | |]; cbv beta; intros.
      + assert (F := frugal_code Hg H). destruct (time_of d x); is_only H0.
        * split; [exact Hr|]. assert (Q := level_clear (keys r) (with_code s N S)). cbn [ensured]. cbn. lia.
        * cbn. lia.
      + is_only H. cbn. lia.
    - cbn [thrifty] in Hr. bools. destruct Hr as [Hg Hr].
      eapply guarded_pays; [exact Ht | | |]; cbv beta; intros.
      + is_only H0. assert (F := frugal_code Hg H). cbn. lia.
      + is_only H. split; [apply thrifty_repeat; assumption|]. assert (Q := level_clear (keys r) S).
        cbn [ensured]. cbn. lia.
      + is_only H. cbn. lia.
    - eapply coded_pays; [exact Ht | |]; cbv beta; intros.
      + destruct (made_task a ys q S x s ds) as [t0|] eqn:M; is_only H0; [|cbn; lia].
        split; [eapply thrifty_made; exact M | cbn; lia].
      + is_only H. cbn. lia.
    - destruct e; [contradiction|].
      destruct (alloc_made (world_of K) (held K) S (free K S) t0 q (taken_numbers K)) as [(vs & r) | m] eqn:A.
      + is_only Ht. unfold alloc_made in A. destruct (opened _ _ _ _ _ _ _) as [(t' & n)|] eqn:O; [|discriminate].
        destruct (assign _ _ _ _); [|discriminate]. injection A as <- <-. split.
        * assert (T : thrifty_task t' = true) by (eapply thrifty_opened; [exact O | exact Hr]).
          destruct (used_of _ _ _); cbn [holding thrifty]; apply thrifty_build; exact T.
        * set (r := build _ _ _ _ _ _). assert (Q := level_clear (keys r) S). cbn [ensured]. cbn. lia.
      + destruct (alloc_made (world_of K) (held K) S (its_bound K S) t0 q (taken_numbers K)); [contradiction|].
        is_only Ht. cbn. lia.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction].
      destruct (mem v (fit q (world_of K) (bound S)) && negb (named K v)); [|contradiction]. is_only Ht.
      split; [reflexivity | cbn; lia].
  Qed.

  Lemma thrifty_part f r : thrifty (plug f r) = true -> thrifty r = true.
  Proof.
    destruct f; cbn [plug thrifty]; bools; try tauto. rewrite forallb_app. cbn [forallb]. bools. tauto.
  Qed.

  Lemma lift_pays f K S r t t' : thrifty (plug f r) = true -> pays_back S r t -> In t' (lift f K t) ->
    pays_back S (plug f r) t'.
  Proof.
    intros Hr Hp Hin.
    assert (After : forall s gone N S1, level S1 <= level (with_code s N S1) ->
      level S1 <= level (after_handler s gone N S1)).
    { intros s gone N S1 H. unfold after_handler. rewrite level_bound. exact H. }
    destruct t as [l S1 [r' | | m | x] E].
    - is_only Hin. destruct Hp as [Ht Hp]. cbn [pays_back]. destruct f; cbn [plug replug thrifty ensured] in *; bools;
        try (split; [tauto | rewrite ?owed_app; lia]).
      + split; [apply thrifty_sequence; tauto | rewrite ensured_sequence; exact Hp].
      + rewrite forallb_app in *. cbn [forallb] in Hr. rewrite forallb_app, thrifty_flat. bools.
        split; [tauto|]. rewrite !flat_map_app, (@through_flat _ _ _ _ through_ensured). cbn [flat_map].
        rewrite !owed_app. lia.
    - cbn [lift] in Hin. destruct Hin as [Hin | []]. subst t'. cbn [pays_back] in Hp.
      destruct f; cbn [plug on_ok pays_back thrifty ensured] in *; bools; try lia.
      + assert (Q := level_clear (keys t) S1). split; [tauto | lia].
      + rewrite forallb_app in Hr. cbn [forallb] in Hr. bools. split.
        * apply thrifty_parallel. rewrite forallb_app. bools. tauto.
        * rewrite (through_parallel _ _ _ through_ensured), !flat_map_app. cbn [flat_map]. rewrite !owed_app. lia.
      + split; [apply thrifty_all_of; tauto | rewrite ensured_all_of, owed_none; lia].
      + destruct g as [g|]; cbn [pays_back thrifty].
        * bools. cbn [if_any] in Hr. split; [tauto | cbn [ensured]; rewrite owed_none; lia].
        * assert (Q := level_clear (keys t) S1).
          split; [apply thrifty_repeat; tauto | rewrite ensured_repeat; cbn [ensured]; lia].
      + assert (Q := level_clear ks S1). lia.
      + rewrite level_does, owed_app. lia.
    - destruct f; cbn [plug lift on_err thrifty ensured] in *; try (is_only Hin; cbn [pays_back ensured] in *; lia).
      + destruct Hin as [<- | []]. cbn [pays_back ensured] in *. rewrite level_does, level_without, !flat_map_app.
        cbn [flat_map]. rewrite !owed_app. lia.
      + unfold on_error in Hin. bools. destruct Hr as [_ Hh].
        destruct (handles_error (handles h) m K S1) as [x s gone N ds | m' ds | m' ds | m' s gone N ds |] eqn:R;
          try contradiction; try (is_only Hin; cbn [pays_back ensured] in *; lia); try (is_only Hin; exact I).
        assert (A := After s gone N S1 (frugal_handlers R)). cbn [pays_back] in Hp.
        destruct x as [ | | | t]; [ | | destruct (anew h) as [(t & q)|] eqn:Ha |
          destruct (anew h) as [(u & q)|] eqn:Ha; [destruct (deepest <=? depth q)|]]; is_only Hin;
          cbn [pays_back ensured]; try lia.
        * split; [|cbn [ensured]; rewrite owed_none; lia]. cbn [thrifty]. unfold thrifty_handler in *.
          rewrite Ha in *. bools. auto.
        * split; [|cbn [ensured]; rewrite owed_none; lia]. cbn [thrifty]. eapply handler_task_thrifty. exact R.
      + destruct Hin as [<- | []]. cbn [pays_back ensured] in *. assert (Q := level_clear ks S1). lia.
      + destruct Hin as [<- | []]. cbn [pays_back ensured] in *. rewrite level_does, owed_app. lia.
    - is_only Hin. exact I.
  Qed.

  Theorem ends_are_done e K S r l S' o E : thrifty r = true -> step e K S r l S' o E -> pays_back S r (By l S' o E).
  Proof.
    intros Hr H. apply step_goes in H. revert Hr.
    induction H as [K S r t H | K S f r t t' _ IH Hl]; intros Hr; [eapply own_pays; eassumption|].
    eapply lift_pays; [exact Hr | apply IH; eapply thrifty_part; exact Hr | exact Hl].
  Qed.

  (** {1 Runs of a task} *)

  (** Steps of the task, and between them what comes from outside and takes nothing, such as inputs. *)
  Inductive comes_to (S : shared) (r : residual) : shared -> outcome -> Prop :=
  | Comes_begun : comes_to S r S (Next r)
  | Comes_step : forall S1 r1 w e l S2 o E,
      comes_to S r S1 (Next r1) -> step e (alone w) S1 r1 l S2 o E -> comes_to S r S2 o
  | Comes_outside : forall S1 r1 S2, comes_to S r S1 (Next r1) -> level S1 <= level S2 -> comes_to S r S2 (Next r1).

  (** While it runs, as much is owed as is missing. When it is done, has failed or is interrupted, all is there. *)
  Theorem using_gives_back S r S' o : thrifty r = true -> comes_to S r S' o ->
    match o with
    | Next r' =>
        level S + owed (ensured r) <= level S' + owed (ensured r') /\
        level S + owed (ensured r) <= level (does (ensured r') S')
    | Ok | Err _ => level S + owed (ensured r) <= level S'
    | Ends _ => True
    end.
  Proof.
    intros Hr H.
    assert (G : pays_back S r (By LScript S' o [])).
    { induction H as [|S1 r1 w e l S2 o E H IH Hs | S1 r1 S2 H IH Hl].
      - split; [exact Hr | lia].
      - destruct IH as [T IH]. apply (ends_are_done T) in Hs.
        destruct o; cbn [pays_back ensured] in *; try exact I; try lia.
        split; [tauto | lia].
      - destruct IH as [T IH]. split; [exact T | lia]. }
    destruct o; cbn [pays_back] in G; auto. rewrite level_does. split; lia.
  Qed.
End Ends.
