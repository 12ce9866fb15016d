(** Laws of tasks that EXECUTE and ALLOCATE begin as the same residual, with the same choices of vehicles: about [V],
    choices of one branch, and one round. *)
From Dolphin Require Export Building.

Section Same_residuals.
  Context {L : Names} {C : Code}.

  (** [t] and [t'], which are open, are given vehicles alike, and begin alike. *)
  Definition alike (t t' : task) : Prop :=
    (leaves t = leaves t' /\ timers t = timers t' /\ places t = places t') /\
    (forall B ok f k, feasible B ok t f k <-> feasible B ok t' f k) /\
    (forall p ok k a b, build p ok t k a b = build p ok t' k a b).

  (** What [t] and [t'] come to be when they are opened: the same numbers of keys, or the same fault. *)
  Definition open_alike (o o' : (task * nat) + message) : Prop :=
    match o, o' with
    | inl (t, n), inl (t', n') => n = n' /\ alike t t'
    | inr m, inr m' => m = m'
    | _, _ => False
    end.

  Definition begin_alike (t t' : task) : Prop :=
    forall inside n, open_alike (open_each inside t n) (open_each inside t' n).

  Ltac opens :=
    let inside := fresh "inside" in let n := fresh "n" in intros inside n; cbn [open_each];
    repeat match goal with
    | |- context [match open_each ?i ?t ?n with _ => _ end] =>
        let u := fresh "u" in let n' := fresh "n" in let m := fresh "m" in
        destruct (open_each i t n) as [(u & n')|m]; [|reflexivity]
    end; split; [reflexivity|].

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
    opens. split; [|split].
    - repeat split.
    - intros B ok f k. cbn [feasible]. rewrite restrict_twice. reflexivity.
    - intros p ok k a b. cbn [build]. rewrite restrict_twice. reflexivity.
  Qed.

  (** [(t >> t')[V] = t[V] >> t'[V]], and the same of the other operators. *)
  Theorem allocated_sequence t t' vs :
    begin_alike (TAllocated (TSequence t t') vs) (TSequence (TAllocated t vs) (TAllocated t' vs)).
  Proof. opens. split; [repeat split | split; [intros B ok f k; cbn; tauto | intros p ok k a b; reflexivity]]. Qed.

  Theorem allocated_parallel t t' vs :
    begin_alike (TAllocated (TParallel t t') vs) (TParallel (TAllocated t vs) (TAllocated t' vs)).
  Proof. opens. split; [repeat split | split; [intros B ok f k; cbn; tauto | intros p ok k a b; reflexivity]]. Qed.

  Theorem allocated_until c g t vs : begin_alike (TAllocated (TUntil c g t) vs) (TUntil c g (TAllocated t vs)).
  Proof. opens. split; [repeat split | split; [intros B ok f k; cbn; tauto | intros p ok k a b; reflexivity]]. Qed.

  Theorem allocated_during c d t vs : begin_alike (TAllocated (TDuring c d t) vs) (TDuring c d (TAllocated t vs)).
  Proof. opens. split; [repeat split | split; [intros B ok f k; cbn; tauto | intros p ok k a b; reflexivity]]. Qed.

  Theorem allocated_repeat n g t vs : begin_alike (TAllocated (TRepeat n g t) vs) (TRepeat n g (TAllocated t vs)).
  Proof. opens. split; [repeat split | split; [intros B ok f k; cbn; tauto | intros p ok k a b; reflexivity]]. Qed.

  (** Of a [watch] that may recover, the task to be allocated again is written otherwise. *)
  Theorem allocated_watch t h vs : may_recover h = false ->
    begin_alike (TAllocated (TWatch t h) vs) (TWatch (TAllocated t vs) h).
  Proof.
    intros Hh. opens. split; [|split].
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

  Lemma open_all_allocated inside vs bs :
    forall n,
    (fix each (bs : list (code * task)) (n : nat) : (list (code * task) * nat) + message :=
       match bs with
       | [] => inl ([], n)
       | (g, a) :: bs =>
           match open_each inside a n with
           | inl (a', n1) => match each bs n1 with inl (bs', n2) => inl ((g, a') :: bs', n2) | inr m => inr m end
           | inr m => inr m
           end
       end) (all_allocated vs bs) n =
    match
      (fix each (bs : list (code * task)) (n : nat) : (list (code * task) * nat) + message :=
         match bs with
         | [] => inl ([], n)
         | (g, a) :: bs =>
             match open_each inside a n with
             | inl (a', n1) => match each bs n1 with inl (bs', n2) => inl ((g, a') :: bs', n2) | inr m => inr m end
             | inr m => inr m
             end
         end) bs n
    with inl (bs', n') => inl (all_allocated vs bs', n') | inr m => inr m end.
  Proof.
    induction bs as [|[g t] bs IH]; intros n; [reflexivity|]. cbn [all_allocated map fst snd open_each].
    destruct (open_each inside t n) as [(u & n1)|m]; [|reflexivity]. fold (all_allocated vs bs). rewrite IH.
    destruct (_ bs n1) as [(bs' & n2)|m]; reflexivity.
  Qed.

  Lemma allocated_branches_open bs vs :
    alike (TAllocated (TAll_of bs) vs) (TAll_of (all_allocated vs bs)) /\
    alike (TAllocated (TOne_of bs) vs) (TOne_of (all_allocated vs bs)).
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

  Theorem allocated_branches bs vs :
    begin_alike (TAllocated (TAll_of bs) vs) (TAll_of (all_allocated vs bs)) /\
    begin_alike (TAllocated (TOne_of bs) vs) (TOne_of (all_allocated vs bs)).
  Proof.
    split; intros inside n; cbn [open_each]; rewrite open_all_allocated;
      (destruct (_ bs n) as [(bs' & n')|m]; [split; [reflexivity | apply allocated_branches_open] | reflexivity]).
  Qed.

  (** [oneOf { when { g } then t } = allOf { when { g } then t }]. *)
  Theorem one_branch g t : begin_alike (TOne_of [(g, t)]) (TAll_of [(g, t)]).
  Proof. opens. split; [repeat split | split; [intros B ok f k; cbn; tauto | intros p ok k a b; reflexivity]]. Qed.

  (** [repeat 1, t = t]. *)
  Theorem repeat_once g t : begin_alike (TRepeat (Some 1) g t) t.
  Proof. opens. split; [repeat split | split; [intros B ok f k; cbn; tauto | intros p ok k a b; reflexivity]]. Qed.

  (** [t ensure { } = t], and [(t ensure { D })[V] = t[V] ensure { D }]. *)
  Theorem ensure_nothing t : begin_alike (TEnsure t []) t.
  Proof. opens. split; [repeat split | split; [intros B ok f k; cbn; tauto | intros p ok k a b; reflexivity]]. Qed.

  Theorem allocated_ensure t ds vs : begin_alike (TAllocated (TEnsure t ds) vs) (TEnsure (TAllocated t vs) ds).
  Proof. opens. split; [repeat split | split; [intros B ok f k; cbn; tauto | intros p ok k a b; reflexivity]]. Qed.

  (** [(t >> t') >> t'' = t >> (t' >> t'')], with the numbers that each part gets. *)
  Lemma sequence_assoc_build r r' r'' : sequence (sequence r r') r'' = sequence r (sequence r' r'').
  Proof. induction r using residual_rect'; cbn [sequence]; try reflexivity. rewrite IHr2. reflexivity. Qed.

  Theorem sequence_begins t t' t'' :
    begin_alike (TSequence (TSequence t t') t'') (TSequence t (TSequence t' t'')).
  Proof.
    opens. split; [|split].
    - cbn [leaves timers places]. repeat split; lia.
    - intros B ok f k. cbn [feasible leaves]. rewrite Nat.add_assoc. tauto.
    - intros p ok k a b. cbn [build leaves timers places]. rewrite sequence_assoc_build, !Nat.add_assoc. reflexivity.
  Qed.

  Lemma open_alike_opened t t' : begin_alike t t' -> forall w h S key q,
    open_alike (opened w h S key q t 0) (opened w h S key q t' 0).
  Proof. intros H w h S key q. destruct (opened_each w h S key q) as (inside & Hi). rewrite !Hi. apply H. Qed.

  (** What begins alike, from the same choice of vehicles, is executed alike. *)
  Theorem alike_executed t t' : begin_alike t t' ->
    forall w h S key q,
    match opened w h S key q t 0, opened w h S key q t' 0 with
    | inl (u, n), inl (u', n') =>
        n = n' /\ forall f B, (feasible B None u f 0 <-> feasible B None u' f 0) /\
          build (top f) None u 0 n 0 = build (top f) None u' 0 n 0
    | inr m, inr m' => m = m'
    | _, _ => False
    end.
  Proof.
    intros H w h S key q. pose proof (open_alike_opened t t' H w h S key q) as Ho. unfold open_alike in Ho.
    destruct (opened w h S key q t 0) as [(u & n)|m], (opened w h S key q t' 0) as [(u' & n')|m']; try exact Ho.
    destruct Ho as (E & _ & H1 & H2). split; [exact E | auto].
  Qed.
End Same_residuals.
