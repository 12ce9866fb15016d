(** Laws of tasks that EXECUTE and ALLOCATE begin as the same residual, with the same choices of vehicles: about [V],
    choices of one branch, and one round. *)
From Dolphin Require Export Building.

Section Same_residuals.
  Context {L : Names} {C : Code}.

  (** [t] and [t'] are given vehicles alike, and begin alike. *)
  Definition begin_alike (t t' : task) : Prop :=
    (leaves t = leaves t' /\ timers t = timers t' /\ places t = places t') /\
    (forall B ok f k, feasible B ok t f k <-> feasible B ok t' f k) /\
    (forall p ok k a b, build p ok t k a b = build p ok t' k a b).

  Lemma both_cons x xs zs : both (x :: xs) zs = if mem x zs then x :: both xs zs else both xs zs.
  Proof. reflexivity. Qed.

  Lemma mem_both x ys zs : mem x (both ys zs) = mem x ys && mem x zs.
  Proof.
    destruct (mem x (both ys zs)) eqn:M; symmetry.
    - apply mem_spec, in_both in M. rewrite andb_true_iff, !mem_spec. exact M.
    - apply mem_false in M. rewrite in_both in M. apply not_true_iff_false. rewrite andb_true_iff, !mem_spec. exact M.
  Qed.

  Lemma both_both xs ys zs : both (both xs ys) zs = both xs (both ys zs).
  Proof.
    induction xs as [|x xs IH]; [reflexivity|]. rewrite !both_cons, mem_both.
    destruct (mem x ys); [rewrite both_cons|]; destruct (mem x zs); cbn [andb]; rewrite IH; reflexivity.
  Qed.

  Lemma restrict_twice ok vs ws : restrict (restrict ok ws) vs = restrict ok (both vs ws).
  Proof. destruct ok; cbn [restrict]; [rewrite both_both|]; reflexivity. Qed.

  (** [t[V][W] = t[V & W]]. *)
  Theorem allocated_twice t vs ws : begin_alike (TAllocated (TAllocated t vs) ws) (TAllocated t (both vs ws)).
  Proof.
    split; [|split].
    - repeat split.
    - intros B ok f k. cbn [feasible]. rewrite restrict_twice. reflexivity.
    - intros p ok k a b. cbn [build]. rewrite restrict_twice. reflexivity.
  Qed.

  (** [(t >> t')[V] = t[V] >> t'[V]], and the same of the other operators. *)
  Theorem allocated_sequence t t' vs :
    begin_alike (TAllocated (TSequence t t') vs) (TSequence (TAllocated t vs) (TAllocated t' vs)).
  Proof. split; [repeat split | split; [intros B ok f k; cbn; tauto | intros p ok k a b; reflexivity]]. Qed.

  Theorem allocated_parallel t t' vs :
    begin_alike (TAllocated (TParallel t t') vs) (TParallel (TAllocated t vs) (TAllocated t' vs)).
  Proof. split; [repeat split | split; [intros B ok f k; cbn; tauto | intros p ok k a b; reflexivity]]. Qed.

  Theorem allocated_until c g t vs : begin_alike (TAllocated (TUntil c g t) vs) (TUntil c g (TAllocated t vs)).
  Proof. split; [repeat split | split; [intros B ok f k; cbn; tauto | intros p ok k a b; reflexivity]]. Qed.

  Theorem allocated_during c d t vs : begin_alike (TAllocated (TDuring c d t) vs) (TDuring c d (TAllocated t vs)).
  Proof. split; [repeat split | split; [intros B ok f k; cbn; tauto | intros p ok k a b; reflexivity]]. Qed.

  Theorem allocated_repeat n g t vs : begin_alike (TAllocated (TRepeat n g t) vs) (TRepeat n g (TAllocated t vs)).
  Proof. split; [repeat split | split; [intros B ok f k; cbn; tauto | intros p ok k a b; reflexivity]]. Qed.

  (** Of a [watch] that may recover, the task to be allocated again is written otherwise. *)
  Theorem allocated_watch t h vs : may_recover h = false ->
    begin_alike (TAllocated (TWatch t h) vs) (TWatch (TAllocated t vs) h).
  Proof.
    intros Hh. split; [|split].
    - repeat split.
    - intros B ok f k. reflexivity.
    - intros p ok k a b. cbn [build]. rewrite Hh. reflexivity.
  Qed.

  Definition all_allocated (vs : list vehicle) (bs : list (code * task)) : list (code * task) :=
    map (fun b => (fst b, TAllocated (snd b) vs)) bs.

  Lemma sums_allocated vs bs :
    list_sum (map (fun b => leaves (snd b)) (all_allocated vs bs)) = list_sum (map (fun b => leaves (snd b)) bs) /\
    list_sum (map (fun b => timers (snd b)) (all_allocated vs bs)) = list_sum (map (fun b => timers (snd b)) bs) /\
    list_sum (map (fun b => places (snd b)) (all_allocated vs bs)) = list_sum (map (fun b => places (snd b)) bs).
  Proof. unfold all_allocated. rewrite !map_map. auto. Qed.

  Theorem allocated_branches bs vs :
    begin_alike (TAllocated (TAll_of bs) vs) (TAll_of (all_allocated vs bs)) /\
    begin_alike (TAllocated (TOne_of bs) vs) (TOne_of (all_allocated vs bs)).
  Proof.
    destruct (sums_allocated vs bs) as (S1 & S2 & S3).
    split; (split; [|split]); try (cbn [leaves timers places]; auto; fail).
    - intros B ok f. cbn [feasible]. clear. induction bs as [|[g t] bs IH]; intros k; [reflexivity|].
      cbn [all_allocated map fst snd feasible leaves]. rewrite (IH (k + leaves t)). reflexivity.
    - intros p ok k a b. cbn [build]. f_equal. clear. revert k a b.
      induction bs as [|[g t] bs IH]; intros k a b; [reflexivity|].
      cbn [all_allocated map fst snd build leaves timers places]. rewrite IH. reflexivity.
    - intros B ok f. cbn [feasible]. clear. induction bs as [|[g t] bs IH]; intros k; [reflexivity|].
      cbn [all_allocated map fst snd feasible leaves]. rewrite (IH (k + leaves t)). reflexivity.
    - intros p ok k a b. cbn [build]. f_equal. clear. revert k a b.
      induction bs as [|[g t] bs IH]; intros k a b; [reflexivity|].
      cbn [all_allocated map fst snd build leaves timers places]. rewrite IH. reflexivity.
  Qed.

  (** [oneOf { when { g } then t } = allOf { when { g } then t }]. *)
  Theorem one_branch g t : begin_alike (TOne_of [(g, t)]) (TAll_of [(g, t)]).
  Proof. split; [repeat split | split; [intros B ok f k; cbn; tauto | intros p ok k a b; reflexivity]]. Qed.

  (** [repeat 1, t = t]. *)
  Theorem repeat_once g t : begin_alike (TRepeat (Some 1) g t) t.
  Proof. split; [repeat split | split; [intros B ok f k; cbn; tauto | intros p ok k a b; reflexivity]]. Qed.

  (** [(t >> t') >> t'' = t >> (t' >> t'')], with the numbers that each part gets. *)
  Lemma sequence_assoc_build r r' r'' : sequence (sequence r r') r'' = sequence r (sequence r' r'').
  Proof. induction r using residual_rect'; cbn [sequence]; try reflexivity. rewrite IHr2. reflexivity. Qed.

  Theorem sequence_begins t t' t'' :
    begin_alike (TSequence (TSequence t t') t'') (TSequence t (TSequence t' t'')).
  Proof.
    split; [|split].
    - cbn [leaves timers places]. repeat split; lia.
    - intros B ok f k. cbn [feasible leaves]. rewrite Nat.add_assoc. tauto.
    - intros p ok k a b. cbn [build leaves timers places]. rewrite sequence_assoc_build, !Nat.add_assoc. reflexivity.
  Qed.

  (** What begins alike, from the same choice of vehicles, is executed alike. *)
  Theorem alike_executed t t' : begin_alike t t' ->
    forall f B, (feasible B None t f 0 <-> feasible B None t' f 0) /\
    build (top f) None t 0 0 0 = build (top f) None t' 0 0 0.
  Proof. intros (_ & H1 & H2) f B. auto. Qed.
End Same_residuals.
