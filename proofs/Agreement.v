(** The function is the relation: [In (By l S' o E) (steps e r K S)] exactly if [step e K S r l S' o E]. *)
From Dolphin Require Export Function.

Section Agreement.
  Context {L : Names} {C : Code}.

  (** {1 Completeness: each rule is a step of the function} *)

  Lemma free_of_bound K S : incl (free K S) (its_bound K S).
  Proof. intros v. unfold free. rewrite filter_In. tauto. Qed.

  Lemma own_code_in e K S r c ys t :
    In (c, ys) (own_code r) -> e = None ->
    (forall gives faulty, In t (coded e c ys K S gives faulty)) ->
    In t (own e K S r).
  Proof.
    intros Hin -> Hc.
    destruct r; cbn in Hin; try tauto;
      try (destruct Hin as [Hin | []]; injection Hin as <- <-; cbn; apply Hc).
    - apply in_map_iff in Hin. destruct Hin as ((g & r) & Hg & Hin). injection Hg as <- <-.
      apply in_split in Hin. destruct Hin as (b & after & ->).
      cbn [own]. apply in_each. exists b, (g, r), after. split; [reflexivity|]. apply Hc.
    - apply in_map_iff in Hin. destruct Hin as ((g & r) & Hg & Hin). injection Hg as <- <-.
      apply in_split in Hin. destruct Hin as (b & after & ->).
      cbn [own]. apply in_each. exists b, (g, r), after. split; [reflexivity|]. apply Hc.
  Qed.

  Lemma step_goes e K S r l S' o E : step e K S r l S' o E -> goes e K S r (By l S' o E).
  Proof.
    induction 1;
      try match goal with
      | IH : goes ?e (enter ?f ?K) _ ?r (By _ _ (Ends _) _) |- goes ?e ?K _ (plug ?f ?r) _ =>
          apply (@Within _ _ e K _ f r _ _ IH); left; reflexivity
      end;
      (* rules about a part *)
      try match goal with
      | IH : goes ?e (enter ?f ?K) ?S ?r ?u |- goes ?e ?K ?S ?whole ?t =>
          change whole with (plug f r); apply (@Within _ _ e K S f r u t IH); cbn; unfold on_error;
          repeat match goal with H : ?x = _ |- context [?x] => rewrite H end;
          try match goal with
          | H : deepest <= ?d |- _ => rewrite (proj2 (Nat.leb_le _ _) H)
          | H : ?d < deepest |- _ => rewrite (proj2 (Nat.leb_gt _ _) H)
          end;
          subst; cbn; auto; fail
      end;
      (* rules of a node *)
      apply Itself;
      try (eapply own_code_in; [eassumption | reflexivity |]; intros gives faulty; unfold coded;
           match goal with H : runs _ _ _ _ = _ |- _ => rewrite H end; left; reflexivity);
      cbn [own];
      try (apply in_each; do 3 eexists; split; [reflexivity|]; unfold choose; cbn [fst snd]);
      unfold guarded, coded, breaks;
      repeat match goal with H : ?x = _ |- context [?x] => rewrite H end;
      try (destruct (vehicle_eq v v); [|congruence]);
      try (destruct (timer_eq i i); [|congruence]);
      try (left; reflexivity).
    - (* ALLOCATE-ERR *)
      destruct (alloc_made (world_of K) (held K) S (free K S) t q (taken_numbers K)) as [(vs & r) | m'] eqn:Hf.
      + exfalso. unfold alloc_made in *.
        destruct (opened (world_of K) (held K) S (fresh (place q) (taken_numbers K)) q t 0) as [(t' & n)|];
          [|discriminate].
        destruct (assign (world_of K) (free K S) (allowed q) t') eqn:Ha; [|discriminate].
        destruct (assign (world_of K) (its_bound K S) (allowed q) t') eqn:Hb; [discriminate|].
        eapply assign_more_law; [exact Ha | apply free_of_bound | exact Hb].
      + left. reflexivity.
    - (* RECRUIT *)
      apply mem_spec in H. rewrite H. left. reflexivity.
  Qed.

  (** {1 Soundness: each step of the function is by a rule} *)

  Ltac is_only H := cbn in H; destruct H as [H | H]; [injection H as <- <- <- <- | contradiction].

  Ltac by_code H :=
    match type of H with context [runs ?c ?ys ?K ?S] =>
      let R := fresh "R" in destruct (runs c ys K S) as [x s N ds | m ds | m ds | m s N ds |] eqn:R
    end; try contradiction.

  Lemma own_step e K S r l S' o E : In (By l S' o E) (own e K S r) -> step e K S r l S' o E.
  Proof.
    intros H. destruct r; cbn [own] in H; try contradiction.
    - (* START *) destruct e; [contradiction|]. is_only H. apply START.
    - (* DONE, FAIL *)
      destruct e as [[]|]; try contradiction; destruct (vehicle_eq v0 v) as [->|]; try contradiction; is_only H.
      + apply DONE.
      + apply FAIL.
    - (* action *)
      unfold coded in H. destruct e; [contradiction|]. by_code H; is_only H.
      + eapply ACTION; eauto.
      + eapply ACTION_ERR; eauto.
      + eapply ASSERT_ERR; [left; reflexivity | eassumption].
      + eapply HALT; [left; reflexivity | eassumption].
    - (* condition *)
      unfold guarded, coded in H. destruct e; [contradiction|]. by_code H.
      + destruct (truth x) as [[]|] eqn:T; try contradiction. is_only H. eapply CONDITION; eauto.
      + destruct (is_unknown m) eqn:U; [contradiction|]. is_only H. eapply CONDITION_ERR; eauto.
      + is_only H. eapply ASSERT_ERR; [left; reflexivity | eassumption].
      + is_only H. eapply HALT; [left; reflexivity | eassumption].
    - (* allOf *)
      apply in_each in H. destruct H as (b & (g & r) & after & -> & H). cbn [app] in H.
      unfold choose, guarded, coded in H. destruct e; [contradiction|]. cbn [fst snd] in H. by_code H.
      + destruct (truth x) as [[]|] eqn:T; try contradiction. is_only H. eapply ALLOF_WHEN; eauto.
      + destruct (is_unknown m) eqn:U; [contradiction|]. is_only H. eapply ALLOF_ERR_guard; eauto.
      + is_only H. eapply ASSERT_ERR; [|eassumption]. cbn. apply in_map_iff. exists (g, r). split; [reflexivity|].
        apply in_elt.
      + is_only H. eapply HALT; [|eassumption]. cbn. apply in_map_iff. exists (g, r). split; [reflexivity|].
        apply in_elt.
    - (* oneOf *)
      apply in_each in H. destruct H as (b & (g & r) & after & -> & H). cbn [app] in H.
      unfold choose, guarded, coded in H. destruct e; [contradiction|]. cbn [fst snd] in H. by_code H.
      + destruct (truth x) as [[]|] eqn:T; try contradiction. is_only H. eapply ONEOF_WHEN; eauto.
      + destruct (is_unknown m) eqn:U; [contradiction|]. is_only H. eapply ONEOF_ERR; eauto.
      + is_only H. eapply ASSERT_ERR; [|eassumption]. cbn. apply in_map_iff. exists (g, r). split; [reflexivity|].
        apply in_elt.
      + is_only H. eapply HALT; [|eassumption]. cbn. apply in_map_iff. exists (g, r). split; [reflexivity|].
        apply in_elt.
    - (* until, assure *)
      unfold guarded, coded in H. destruct e; [contradiction|]. by_code H.
      + destruct (truth x) as [[]|] eqn:T; try contradiction; destruct k; try contradiction; is_only H.
        * eapply UNTIL_CUT; eauto.
        * eapply ASSURE_CUT; eauto.
      + destruct (is_unknown m) eqn:U; [contradiction|]. is_only H. eapply UNTIL_ERR_guard; eauto.
      + is_only H. eapply ASSERT_ERR; [left; reflexivity | eassumption].
      + is_only H. eapply HALT; [left; reflexivity | eassumption].
    - (* idle *)
      destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i) as [->|]; [|contradiction]. is_only H.
      apply IDLE_END.
    - (* confirm *)
      destruct e as [[]|]; try contradiction.
      + destruct yes; (destruct (timer_eq i0 i) as [->|]; [|contradiction]); is_only H.
        * apply CONFIRM_YES.
        * apply CONFIRM_NO.
      + destruct (timer_eq i0 i) as [->|]; [|contradiction]. is_only H. apply CONFIRM_NO_answer.
    - (* during, within *)
      destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i) as [->|]; [|contradiction]. is_only H.
      destruct k; cbn; [apply DURING_CUT | apply WITHIN_CUT].
    - (* during { d }, within { d } *)
      unfold coded in H. destruct e; [contradiction|]. by_code H.
      + destruct (time_of d x) as [n | m] eqn:T; is_only H.
        * eapply DURING_SET; eauto.
        * eapply DURING_ERR_time; eauto.
      + is_only H. eapply DURING_ERR_code; eauto.
      + is_only H. eapply ASSERT_ERR; [left; reflexivity | eassumption].
      + is_only H. eapply HALT; [left; reflexivity | eassumption].
    - (* repeat(q) *)
      unfold guarded, coded in H. destruct e; [contradiction|]. by_code H.
      + destruct (truth x) as [[]|] eqn:T; try contradiction; is_only H.
        * eapply REPEAT_UNTIL; eauto.
        * eapply REPEAT_AGAIN; eauto.
      + destruct (is_unknown m) eqn:U; [contradiction|]. is_only H. eapply REPEAT_ERR_guard; eauto.
      + is_only H. eapply ASSERT_ERR; [left; reflexivity | eassumption].
      + is_only H. eapply HALT; [left; reflexivity | eassumption].
    - (* made *)
      unfold coded in H. destruct e; [contradiction|]. by_code H.
      + destruct (made_task a ys q S x s ds) as [t|] eqn:T; is_only H.
        * eapply MAKE; eauto.
        * eapply MAKE_ERR_value; eauto.
      + is_only H. eapply MAKE_ERR; eauto.
      + is_only H. eapply ASSERT_ERR; [left; reflexivity | eassumption].
      + is_only H. eapply HALT; [left; reflexivity | eassumption].
    - (* unallocated *)
      destruct e; [contradiction|].
      destruct (alloc_made (world_of K) (held K) S (free K S) t q (taken_numbers K)) as [(vs & r) | m'] eqn:Hf.
      + is_only H. apply ALLOCATE. exact Hf.
      + destruct (alloc_made (world_of K) (held K) S (its_bound K S) t q (taken_numbers K)) eqn:Hb; [contradiction|].
        is_only H. apply ALLOCATE_ERR. exact Hb.
    - (* recruit *)
      destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i) as [->|]; [|contradiction].
      destruct (mem v (fit q (world_of K) (bound S))) eqn:M; [|contradiction]. apply mem_spec in M.
      destruct (named K v) eqn:Nm; cbn in H; [contradiction|]. destruct H as [H | []]. injection H as <- <- <- <-.
      apply RECRUIT; assumption.
  Qed.

  Lemma lift_step e K S f r l S1 o E t' :
    step e (enter f K) S r l S1 o E -> In t' (lift f K (By l S1 o E)) ->
    match t' with By l' S' o' E' => step e K S (plug f r) l' S' o' E' end.
  Proof.
    intros H Hin. destruct t' as [l' S' o' E']. destruct o as [r' | | m | x].
    - is_only Hin. destruct f; cbn [plug replug].
      + apply SEQ_1; assumption.
      + apply PAR_1; assumption.
      + apply ALLOF_1; assumption.
      + apply UNTIL_1; assumption.
      + apply DURING_1; assumption.
      + apply WATCH_1; assumption.
      + apply REPEAT_1; assumption.
      + apply HOLD_1; assumption.
      + apply RECRUIT_1; assumption.
      + apply FRESH_1; assumption.
      + apply ENSURE_1; assumption.
    - destruct f as [| | | | | | ? g ? | | | |]; [..|destruct g|idtac|idtac|idtac|idtac]; is_only Hin; cbn [plug].
      + apply SEQ_2; assumption.
      + apply PAR_2; assumption.
      + apply ALLOF_2; assumption.
      + apply UNTIL_2; assumption.
      + apply DURING_2; assumption.
      + apply WATCH_2; assumption.
      + apply REPEAT_2_condition; assumption.
      + apply REPEAT_2; assumption.
      + apply HOLD_2; assumption.
      + apply RECRUIT_2; assumption.
      + apply FRESH_2; assumption.
      + apply ENSURE_2; assumption.
    - destruct f; cbn [lift on_err plug] in Hin |- *; try (is_only Hin).
      + apply SEQ_ERR; assumption.
      + apply PAR_ERR; assumption.
      + apply ALLOF_ERR; assumption.
      + apply UNTIL_ERR; assumption.
      + apply DURING_ERR; assumption.
      + unfold on_error in Hin.
        destruct (handles_error (handles h) m K S1) as [x s gone N ds | m' ds | m' ds | m' s gone N ds |] eqn:R;
          try contradiction.
        * destruct x; [is_only Hin .. | |].
          -- eapply WATCH_IGNORE; eauto.
          -- eapply WATCH_PROPAGATE; eauto.
          -- destruct (anew h) as [(t & q)|] eqn:A; is_only Hin.
             ++ eapply WATCH_RETRY; eauto.
             ++ eapply WATCH_PROPAGATE_foreign; eauto.
          -- destruct (anew h) as [(u & q)|] eqn:A.
             ++ destruct (deepest <=? depth q) eqn:D; is_only Hin.
                ** eapply WATCH_PROPAGATE_deep; eauto. apply Nat.leb_le. exact D.
                ** eapply WATCH_INSTEAD; eauto. apply Nat.leb_gt. exact D.
             ++ is_only Hin. eapply WATCH_PROPAGATE_value; eauto.
        * is_only Hin. eapply WATCH_PROPAGATE_fault; eauto.
        * is_only Hin. eapply ASSERT_ERR_handler; eauto.
        * is_only Hin. eapply WATCH_HALT; eauto.
      + apply REPEAT_ERR; assumption.
      + apply HOLD_ERR; assumption.
      + apply RECRUIT_ERR; assumption.
      + apply FRESH_ERR; assumption.
      + apply ENSURE_ERR; assumption.
    - is_only Hin. apply ENDS. exact H.
  Qed.

  Lemma goes_step e K S r t : goes e K S r t -> match t with By l S' o E => step e K S r l S' o E end.
  Proof.
    induction 1 as [K S r [l S' o E] H | K S f r [l S' o E] t' _ IH Hl].
    - apply own_step. exact H.
    - eapply lift_step; eauto.
  Qed.

  (** {1 The theorem} *)

  Theorem goes_iff_step e K S r l S' o E : goes e K S r (By l S' o E) <-> step e K S r l S' o E.
  Proof. split; [apply (@goes_step e K S r (By l S' o E)) | apply step_goes]. Qed.

  (** Internal transitions, for [e = None], and those by an event. *)
  Theorem function_is_relation e K S r l S' o E : In (By l S' o E) (steps e r K S) <-> step e K S r l S' o E.
  Proof. rewrite steps_iff_goes. apply goes_iff_step. Qed.

  Corollary internal_sound_and_complete K S r l S' o E :
    In (By l S' o E) (steps None r K S) <-> step None K S r l S' o E.
  Proof. apply function_is_relation. Qed.

  Corollary events_sound_and_complete x K S r l S' o E :
    In (By l S' o E) (steps (Some x) r K S) <-> step (Some x) K S r l S' o E.
  Proof. apply function_is_relation. Qed.
End Agreement.
