(** The residual of a task whose vehicles are chosen: it is well formed, as it was built, and names these vehicles. *)
From Dolphin Require Export Residual_facts.

Section Building.
  Context {L : Names} {C : Code}.

  Definition built (B : list vehicle) (f : nat -> vehicle) (n k : nat) (r : residual) : Prop :=
    Wf (fun v => In v B) r /\ quiet r = true /\ forall v, In v (names r) -> In v (map f (seq k n)).

  Lemma chosen_app (f : nat -> vehicle) k n m v :
    In v (map f (seq k (n + m))) <-> In v (map f (seq k n)) \/ In v (map f (seq (k + n) m)).
  Proof. rewrite seq_app, map_app, in_app_iff. reflexivity. Qed.

  Lemma built_branches (p : supply) (B : list vehicle) ok (bs : list (code * task)) :
    Forall (fun b => forall ok k a b',
              feasible B ok (snd b) (choice p) k -> built B (choice p) (leaves (snd b)) k (build p ok (snd b) k a b')) bs ->
    forall k a b,
    (fix branches (bs : list (code * task)) (k : nat) : Prop :=
       match bs with
       | [] => True
       | (_, a) :: bs => feasible B ok a (choice p) k /\ branches bs (k + leaves a)
       end) bs k ->
    let rs :=
      (fix branches (bs : list (code * task)) (k a b : nat) : list branch :=
         match bs with
         | [] => []
         | (g, t) :: bs => (g, build p ok t k a b) :: branches bs (k + leaves t) (a + timers t) (b + places t)
         end) bs k a b in
    (forall b, In b rs -> Wf (fun v => In v B) (snd b)) /\ forallb (fun b => quiet (snd b)) rs = true /\
    forall v, In v (flat_map (fun b => names (snd b)) rs) ->
              In v (map (choice p) (seq k (list_sum (map (fun b => leaves (snd b)) bs)))).
  Proof.
    induction 1 as [|(g, t) bs Hb _ IH]; intros k a b Hf; cbn [map list_sum fold_right snd].
    - split; [intros b' [] | split; [reflexivity | intros v []]].
    - destruct Hf as [Ht Hf]. destruct (Hb ok k a b Ht) as (W & Q & N).
      destruct (IH (k + leaves t) (a + timers t) (b + places t) Hf) as (W' & Q' & N').
      cbn [snd] in *. split; [|split].
      + intros b' [<- | Hin]; auto.
      + cbn [forallb snd]. rewrite Q. exact Q'.
      + intros v. cbn [flat_map snd]. rewrite in_app_iff.
        change (fold_right Nat.add 0) with list_sum.
        intros [Hv | Hv]; apply chosen_app; auto.
  Qed.

  Lemma build_built (p : supply) (B : list vehicle) t :
    forall ok k a b,
    feasible B ok t (choice p) k -> built B (choice p) (leaves t) k (build p ok t k a b).
  Proof.
    induction t using task_rect'; intros ok k0 a0 b0 Hf; cbn [build leaves] in *;
      try (split; [constructor | split; [reflexivity | intros v []]]; fail).
    - cbn in Hf. split; [constructor; tauto | split; [reflexivity|]]. intros v [<- | []]. left. reflexivity.
    - destruct Hf as [F1 F2]. destruct (IHt1 _ _ a0 b0 F1) as (W1 & Q1 & N1).
      destruct (IHt2 _ _ (a0 + timers t1) (b0 + places t1) F2) as (W2 & Q2 & N2).
      split; [apply Wf_sequence; assumption | split].
      + rewrite quiet_sequence, Q1, Q2. reflexivity.
      + intros v. rewrite names_sequence, chosen_app. intuition.
    - destruct Hf as (F1 & F2 & D). destruct (IHt1 _ _ a0 b0 F1) as (W1 & Q1 & N1).
      destruct (IHt2 _ _ (a0 + timers t1) (b0 + places t1) F2) as (W2 & Q2 & N2).
      split; [|split].
      + apply Wf_parallel.
        * intros q [<- | [<- | []]]; assumption.
        * cbn. split; [|split; [intros v _ []|exact I]]. intros v Hv. rewrite app_nil_r. intros Hv'.
          apply (D v); [apply N1; exact Hv | apply N2; exact Hv'].
      + unfold parallel. cbn [flat_map]. rewrite app_nil_r.
        assert (HQ : forallb quiet (flat (build p ok t1 k0 a0 b0) ++
          flat (build p ok t2 (k0 + leaves t1) (a0 + timers t1) (b0 + places t1))) = true).
        { rewrite forallb_app. apply andb_true_iff. split.
          - destruct (build p ok t1 k0 a0 b0); cbn in *; rewrite ?Q1; auto.
          - destruct (build p ok t2 _ _ _); cbn in *; rewrite ?Q2; auto. }
        destruct (_ ++ _) as [|r [|r' rest]]; cbn in *; auto. rewrite andb_true_r in HQ. exact HQ.
      + intros v. rewrite (through_parallel _ _ _ through_names). cbn [flat_map]. rewrite app_nil_r, in_app_iff, chosen_app.
        intuition.
    - apply IHt. exact Hf.
    - destruct (built_branches p B ok bs H k0 a0 b0 Hf) as (W & Q & N). split; [|split].
      + apply Wf_all_of; assumption.
      + unfold all_of. destruct (_ bs k0 a0 b0) as [|b1 [|b2 rest]]; cbn in *; auto.
      + intros v. rewrite names_all_of. apply N.
    - destruct (built_branches p B ok bs H k0 a0 b0 Hf) as (W & Q & N). split; [|split].
      + constructor; assumption.
      + exact Q.
      + exact N.
    - destruct (IHt ok k0 a0 b0 Hf) as (W & Q & N). split; [constructor; exact W | split; assumption].
    - destruct d as [n | d]; destruct (IHt ok k0 (Datatypes.S a0) b0 Hf) as (W & Q & N);
        (split; [constructor; assumption | split; assumption]).
    - destruct (may_recover h).
      + destruct (IHt ok k0 a0 (Datatypes.S b0) Hf) as (W & Q & N). split; [constructor; exact W | split; assumption].
      + destruct (IHt ok k0 a0 b0 Hf) as (W & Q & N). split; [constructor; exact W | split; assumption].
    - destruct (IHt ok k0 a0 b0 Hf) as (W & Q & N). split; [apply Wf_repeat; assumption | split].
      + unfold repeat_. destruct (option_map pred n) as [[|m]|]; cbn; rewrite ?Q; reflexivity.
      + intros v Hv. apply names_repeat in Hv. destruct Hv; auto.
    - destruct (IHt ok k0 a0 b0 Hf) as (W & Q & N). split; [constructor; exact W | split; assumption].
    - destruct (IHt ok k0 a0 b0 Hf) as (W & Q & N).
      destruct (ensure_same (build p ok t k0 a0 b0) ds) as (E1 & _ & _ & _ & E2 & _).
      split; [apply Wf_ensure; exact W | rewrite E1, E2; split; assumption].
  Qed.

  Lemma feasible_chosen B f t :
    forall ok k, feasible B ok t f k -> forall v, In v (map f (seq k (leaves t))) -> In v B.
  Proof.
    induction t using task_rect'; intros ok k0 Hf v Hv; cbn [feasible leaves] in *; try contradiction.
    - destruct Hv as [<- | []]. tauto.
    - apply chosen_app in Hv. destruct Hf. destruct Hv; eauto.
    - apply chosen_app in Hv. destruct Hf as (? & ? & ?). destruct Hv; eauto.
    - eauto.
    - revert k0 Hf Hv. induction H as [|(g, t) bs Hb _ IH]; intros k0 Hf Hv; [contradiction|].
      cbn [map list_sum fold_right snd] in Hv. change (fold_right Nat.add 0) with list_sum in Hv.
      apply chosen_app in Hv. destruct Hf as [F1 F2]. destruct Hv as [Hv | Hv]; [eapply Hb; eauto | eauto].
    - revert k0 Hf Hv. induction H as [|(g, t) bs Hb _ IH]; intros k0 Hf Hv; [contradiction|].
      cbn [map list_sum fold_right snd] in Hv. change (fold_right Nat.add 0) with list_sum in Hv.
      apply chosen_app in Hv. destruct Hf as [F1 F2]. destruct Hv as [Hv | Hv]; [eapply Hb; eauto | eauto].
    - eauto.
    - eauto.
    - eauto.
    - eauto.
    - eauto.
    - eauto.
  Qed.

  (** What EXECUTE begins. *)
  Theorem alloc_built w S t r :
    alloc w S t = inl r ->
    Wf (fun v => In v (bound S)) r /\ quiet r = true /\ forall v, In v (names r) -> In v (bound S).
  Proof.
    unfold alloc. destruct (opened _ _ _ _ _ t 0) as [(t' & n)|]; [|discriminate].
    destruct (assign w (bound S) None t') as [f|m] eqn:A; [|discriminate]. intros H. injection H as <-.
    apply assign_law in A. destruct (build_built (top f) (bound S) t' None 0 n 0 A) as (W & Q & N).
    split; [exact W | split; [exact Q|]]. intros v Hv. apply N in Hv. cbn [choice top] in Hv.
    eapply feasible_chosen; eauto.
  Qed.

  (** What ALLOCATE begins: its vehicles are of B, and it names no others. *)
  Theorem alloc_made_built w h S B t q used vs r :
    alloc_made w h S B t q used = inl (vs, r) ->
    Wf (fun v => In v B) r /\ quiet r = true /\ (forall v, In v (names r) -> In v B) /\ incl vs B.
  Proof.
    unfold alloc_made. destruct (opened _ _ _ _ _ t 0) as [(t' & n)|]; [|discriminate].
    destruct (assign w B (allowed q) t') as [f|m] eqn:A; [|discriminate]. intros H.
    injection H as <- <-. apply assign_law in A.
    destruct (build_built (made_at q used f) B t' (allowed q) 0 n 0 A) as (W & Q & N).
    split; [exact W | split; [exact Q | split]].
    - intros v Hv. apply N in Hv. eapply feasible_chosen; eauto.
    - intros v. unfold used_of. rewrite filter_In, nodup_In. tauto.
  Qed.
End Building.
