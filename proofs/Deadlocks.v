(** Deadlocks of [dolphin explore]: a configuration that has not ended and has no transition in its world, other than an
    input or an interruption. All that is active in it waits for guards, for vehicles that others hold, or for vehicles
    that this world does not have. *)
From Dolphin Require Export Normal_forms.

Section Deadlocks.
  Context {L : Names} {C : Code}.

  (** Frames that add no step of their own. *)
  Definition passive (f : frame) : Prop :=
    match f with Beside _ _ | Body_until _ _ | Body_during _ _ _ => False | _ => True end.

  (** As [stuck], but a [recruit] that no vehicle of the world can meet waits too. *)
  Inductive blocked : context -> shared -> residual -> Prop :=
  | B_stuck : forall K S r, stuck K S r -> blocked K S r
  | B_recruit : forall K S i q a j d,
      (forall v, In v (fit q (world_of K) (bound S)) -> named K v = true) -> blocked K S (Recruit i q a j d)
  | B_until : forall K S k g r,
      guard_waits (wanted k) g K S -> blocked (enter (Body_until k g) K) S r -> blocked K S (Until k g r)
  | B_parallel : forall K S rs,
      (forall b r a, rs = b ++ r :: a -> blocked (enter (Beside b a) K) S r) -> blocked K S (Parallel rs)
  | B_frame : forall K S f r, passive f -> blocked (enter f K) S r -> blocked K S (plug f r).

  (** Events that count: what may come at any time does not end a deadlock. *)
  Definition counts (e : option event) : Prop :=
    match e with Some (Input _ _) | Some Interruption => False | _ => True end.

  Definition acts (K : context) (S : shared) (r : residual) : Prop := exists e t, counts e /\ goes e K S r t.

  Lemma inside_acts f r K S : closed_world -> acts (enter f K) S r -> acts K S (plug f r).
  Proof.
    intros Hc (e & t & He & Ht). destruct (inside_steps e f r K S Hc (ex_intro _ t Ht)) as [t' Ht'].
    exists e, t'. auto.
  Qed.

  (** A residual that awaits nothing acts by itself, or is stuck. *)
  Lemma leaf_acts r K S : closed_world -> full r = true -> awaits r = [] -> acts K S r \/ blocked K S r.
  Proof.
    intros Hc Hf Ha. destruct (residuals_progress r Hc K S Hf) as [(l & S' & o & E & Hs) | [H | H]].
    - left. exists None, (By l S' o E). split; [exact I | apply goes_iff_step; exact Hs].
    - contradiction.
    - right. apply B_stuck. exact H.
  Qed.

  Lemma parallel_acts rs K S :
    closed_world -> Forall (fun r => forall K, full r = true -> acts K S r \/ blocked K S r) rs ->
    forallb full rs = true -> acts K S (Parallel rs) \/ blocked K S (Parallel rs).
  Proof.
    intros Hc HF HQ.
    assert (G : forall pre post, rs = pre ++ post ->
      acts K S (Parallel rs) \/ (forall b r a, post = b ++ r :: a -> blocked (enter (Beside (pre ++ b) a) K) S r)).
    { intros pre post. revert pre. induction post as [|q post IH]; intros pre Hrs.
      - right. intros b r a Hn. destruct b; discriminate.
      - destruct (IH (pre ++ [q])) as [Hs | Hk]; auto.
        { rewrite <- app_assoc. exact Hrs. }
        rewrite Forall_forall in HF. rewrite forallb_forall in HQ.
        assert (Hq : In q rs) by (rewrite Hrs; apply in_elt).
        destruct (HF q Hq (enter (Beside pre post) K) (HQ q Hq)) as [Hs | Hk'].
        + left. rewrite Hrs. apply (inside_acts (Beside pre post) q K S Hc Hs).
        + right. intros b r a Hp. destruct b as [|y b]; injection Hp as -> ->.
          * rewrite app_nil_r. exact Hk'.
          * specialize (Hk b r a eq_refl). rewrite <- app_assoc in Hk. exact Hk. }
    destruct (G [] rs eq_refl) as [H | H]; [auto|]. right. apply B_parallel. exact H.
  Qed.

  Theorem acts_or_blocked r : closed_world -> forall K S, full r = true -> acts K S r \/ blocked K S r.
  Proof.
    intros Hc. induction r using residual_rect'; intros K S Q;
      try (apply leaf_acts; [exact Hc | exact Q | reflexivity]);
      try match goal with
      | IH : forall K S, full ?r = true -> _ |- acts _ _ ?whole \/ _ =>
          match whole with
          | Sequence r ?t => pose (f := In_sequence t)
          | Branch r ?bs => pose (f := Branch_of bs)
          | Fresh ?ks r => pose (f := With_keys ks)
          | Ensure r ?ds => pose (f := Ensuring ds)
          | Watch r ?h => pose (f := In_watch h)
          | Repeat r ?n ?g ?t => pose (f := Round_of n g t)
          | Holding ?vs r => pose (f := Held_by vs)
          | Recruited ?v r => pose (f := In_recruited v)
          end;
          destruct (IH (enter f K) S Q) as [Hs | Hk];
          [left; apply (inside_acts f r K S Hc Hs) | right; apply (B_frame K S f r I Hk)]
      end.
    - (* a task that runs *)
      left. exists (Some (Done v)), (By (LDone v p) (without [v] S) Ok []). split; [exact I|]. apply Itself. cbn.
      destruct (vehicle_eq v v); [left; reflexivity | congruence].
    - (* side by side *)
      cbn [full] in Q. apply andb_true_iff in Q. destruct Q as [_ Q]. apply parallel_acts; auto.
      rewrite Forall_forall in *. intros q Hq K' Hf. apply H; auto.
    - (* until, assure *)
      destruct (IHr (enter (Body_until k g) K) S Q) as [Hs | Hk].
      + left. apply (inside_acts (Body_until k g) r K S Hc Hs).
      + destruct (until_dec k g r K S Hc) as [[t Ht] | Hw].
        * left. exists None, t. split; [exact I | exact Ht].
        * right. apply B_until; assumption.
    - (* idle *)
      left. exists (Some (Expired i)), (By LTimeout S Ok []). split; [exact I|]. apply Itself. cbn.
      destruct (timer_eq i i); [left; reflexivity | congruence].
    - (* confirm *)
      left. exists (Some (Answered i true)), (By (LAnswered true) S Ok []). split; [exact I|]. apply Itself. cbn.
      destruct (timer_eq i i); [left; reflexivity | congruence].
    - (* during, within *)
      left. exists (Some (Expired i)). eexists. split; [exact I|]. apply Itself. cbn.
      destruct (timer_eq i i); [left; reflexivity | congruence].
    - (* recruit *)
      destruct (List.filter (fun v => negb (named K v)) (fit q (world_of K) (bound S))) as [|v vs] eqn:F.
      + right. apply B_recruit. intros v Hv. destruct (named K v) eqn:E; [reflexivity|].
        assert (Hin : In v (List.filter (fun v => negb (named K v)) (fit q (world_of K) (bound S)))).
        { apply filter_In. rewrite E. auto. }
        rewrite F in Hin. contradiction.
      + left. assert (Hin : In v (v :: vs)) by (left; reflexivity). rewrite <- F in Hin.
        apply filter_In in Hin. destruct Hin as [Hv Hn].
        exists (Some (Comes i v)). eexists. split; [exact I|]. apply Itself. cbn.
        destruct (timer_eq i i); [|congruence]. rewrite (proj2 (mem_spec v _) Hv), Hn. left. reflexivity.
  Qed.

  Lemma blocked_has_no_step : forall K S r, blocked K S r -> forall e t, ~ goes e K S r t.
  Proof.
    assert (One : forall e f K S r t, own e K S (plug f r) = [] -> parts (plug f r) = [(f, r)] ->
      (forall t, ~ goes e (enter f K) S r t) -> ~ goes e K S (plug f r) t).
    { clear. intros e f K S r t Ho Hp Hs Hg. apply goes_are_steps, steps_parts in Hg. rewrite Ho, Hp in Hg.
      destruct Hg as [[] | (f' & r' & [Hin | []] & Hg)]. injection Hin as <- <-.
      apply in_flat_map in Hg. destruct Hg as (u & Hu & _). apply steps_are_goes in Hu. eapply Hs. exact Hu. }
    induction 1 as [K S r Hs | K S i q a j d Hf | K S k g r Hw _ IH | K S rs _ IH | K S f r Hp _ IH]; intros e t.
    - apply stuck_has_no_step. exact Hs.
    - intros Hg. apply goes_are_steps, steps_parts in Hg. destruct Hg as [Hg | (f & p & [] & _)]. cbn in Hg.
      destruct e as [[ | | | | | i' v | | | | | | ]|]; try contradiction.
      destruct (timer_eq i' i); [|contradiction].
      destruct (mem v (fit q (world_of K) (bound S)) && negb (named K v)) eqn:M; [|contradiction].
      apply andb_true_iff in M. destruct M as [M1 M2]. apply mem_spec, Hf in M1. rewrite M1 in M2. discriminate.
    - apply (One e (Body_until k g)); [|reflexivity | apply IH]. cbn. apply (guard_waits_nothing (wanted k)); auto;
        destruct k; cbn; intros; congruence.
    - intros Hg. apply goes_are_steps, steps_parts in Hg. destruct Hg as [[] | (f & p & Hp & Hg)].
      apply in_parts in Hp. destruct f; cbn in Hp; try discriminate. injection Hp as ->.
      apply in_flat_map in Hg. destruct Hg as (u & Hu & _). apply steps_are_goes in Hu.
      eapply IH; [reflexivity | exact Hu].
    - apply One; [| |apply IH]; destruct f; cbn in Hp |- *; try contradiction; reflexivity.
  Qed.

  (** {1 Of configurations} *)

  (** The verdict "no deadlock" of [dolphin explore] is about these. *)
  Definition deadlocked (w : world) (c : configuration) : Prop :=
    (forall e, control_of c <> End e) /\ forall x l c' E, cstep w x c l c' E -> ~ counts x.

  Lemma Sub_nothing X (xs : list X) : Sub [] xs.
  Proof. induction xs; constructor; assumption. Qed.

  Lemma Sub_first X n : forall xs : list X, n <= length xs -> exists V, Sub V xs /\ n = length V.
  Proof.
    induction n as [|n IH]; intros xs H.
    - exists []. split; [apply Sub_nothing | reflexivity].
    - destruct xs as [|x xs]; cbn in H; [lia|]. destruct (IH xs) as (V & HV & Hl); [lia|].
      exists (x :: V). split; [constructor; exact HV | cbn; congruence].
  Qed.

  (** What the script waits for may come: the vehicles are there, or the time is over; an answer, or nobody answers. *)
  Lemma waiting_acts w M q S (m : message) :
    exists x l c' E, counts x /\ cstep w x (waits_at M q S) l c' E.
  Proof.
    destruct q as [q | x | n | c].
    - destruct (enough q (fit (asked q) w (bound S))) eqn:E0.
      + unfold enough in E0. destruct (count q) as [n|] eqn:Hn.
        * apply Nat.leb_le in E0. destruct (@Sub_first _ n _ E0) as (V & HV & ->).
          exists None. do 3 eexists. split; [exact I|]. apply PICK_BIND; [exact HV | exact Hn].
        * destruct (fit (asked q) w (bound S)) as [|v vs] eqn:F; [discriminate|].
          exists (Some (Expired script_timer)). do 3 eexists. split; [exact I|]. apply PICK_BIND_all; eassumption.
      + exists (Some (Expired script_timer)). destruct (otherwise q) eqn:O; do 3 eexists; (split; [exact I|]).
        * apply PICK_ELSE; assumption.
        * apply PICK_ERR; assumption.
    - exists (Some (No_text m)). do 3 eexists. split; [exact I | apply ANSWER_ERR].
    - exists (Some (Expired script_timer)). do 3 eexists. split; [exact I | apply RESUME].
    - exists (Some (Host_failed m)). do 3 eexists. split; [exact I | apply CALL_ERR].
  Qed.

  (** In a closed world, a configuration that a program comes to is a deadlock exactly if it executes a task of which all
      that is active waits for guards, or for vehicles that are held or are not there. ([m] is any message.) *)
  Theorem deadlocks_are_blocked M s N c w (m : message) :
    closed_world -> honest_script -> reachable M s N c ->
    deadlocked w c <-> exists M' r, control_of c = Exec M' r /\ blocked (alone w) (shared_of c) r.
  Proof.
    intros Hc Hs Hr. assert (P := configurations_progress M s N c w Hc Hs Hr).
    destruct c as [[M' | M' q | M' r | y] S]; cbn [control_of shared_of] in *; split.
    - intros [_ H]. destruct P as (l & c' & E & Hstep). exfalso. apply (H _ _ _ _ Hstep). exact I.
    - intros (M1 & r & H & _). discriminate.
    - intros [_ H]. destruct (waiting_acts w M' q S m) as (x & l & c' & E & Hx & Hstep). exfalso.
      apply (H _ _ _ _ Hstep). exact Hx.
    - intros (M1 & r & H & _). discriminate.
    - intros [_ H]. exists M', r. split; [reflexivity|].
      assert (Hf : full r = true) by (apply normal_full; eapply always_normal; [exact Hr | reflexivity]).
      destruct (acts_or_blocked r Hc (alone w) S Hf) as [(e & [l S' o E] & He & Hg) | Hb]; [exfalso | exact Hb].
      apply goes_iff_step in Hg. destruct o as [r' | | m' | x].
      + apply (H _ _ _ _ (EXECUTING w e M' S r l S' r' E Hg)). exact He.
      + apply (H _ _ _ _ (EXECUTE_DONE w e M' S r l S' E Hg)). exact He.
      + apply (H _ _ _ _ (EXECUTE_ERR w e M' S r l S' m' E Hg)). exact He.
      + apply (H _ _ _ _ (ENDS_all w e M' S r l S' x E Hg)). exact He.
    - intros (M1 & r' & H & Hb). injection H as <- <-. split; [discriminate|]. intros x l c' E Hstep.
      remember {| control_of := Exec M' r; shared_of := S |} as c eqn:Ec.
      destruct Hstep; try discriminate Ec; try (intros []; fail); injection Ec; intros; subst;
        match goal with H : step _ _ _ _ _ _ _ _ |- _ => apply goes_iff_step in H end;
        exfalso; eapply blocked_has_no_step; eassumption.
    - intros [H _]. exfalso. eapply H. reflexivity.
    - intros (M1 & r & H & _). discriminate.
  Qed.

  (** What is no end has a transition that counts, or is a deadlock of guards and vehicles. *)
  Corollary progress M s N c w (m : message) :
    closed_world -> honest_script -> reachable M s N c -> (forall e, control_of c <> End e) ->
    (exists x l c' E, counts x /\ cstep w x c l c' E) \/
    exists M' r, control_of c = Exec M' r /\ blocked (alone w) (shared_of c) r.
  Proof.
    intros Hc Hs Hr He. assert (P := configurations_progress M s N c w Hc Hs Hr).
    destruct c as [[M' | M' q | M' r | y] S]; cbn [control_of shared_of] in *.
    - left. exists None. destruct P as (l & c' & E & H). exists l, c', E. split; [exact I | exact H].
    - left. apply (waiting_acts w M' q S m).
    - assert (Hf : full r = true) by (apply normal_full; eapply always_normal; [exact Hr | reflexivity]).
      destruct (acts_or_blocked r Hc (alone w) S Hf) as [(e & [l S' o E] & Hx & Hg) | Hb]; [left | right; eauto].
      apply goes_iff_step in Hg. exists e, l. destruct o as [r' | | m' | x].
      + do 2 eexists. split; [exact Hx | apply (EXECUTING w e M' S r l S' r' E Hg)].
      + do 2 eexists. split; [exact Hx | apply (EXECUTE_DONE w e M' S r l S' E Hg)].
      + do 2 eexists. split; [exact Hx | apply (EXECUTE_ERR w e M' S r l S' m' E Hg)].
      + do 2 eexists. split; [exact Hx | apply (ENDS_all w e M' S r l S' x E Hg)].
    - exfalso. eapply He. reflexivity.
  Qed.
End Deadlocks.
