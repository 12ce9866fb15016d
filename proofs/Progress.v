(** Progress: a residual has a step, or awaits an event, or waits for nothing but guards and vehicles; the last is what
    [dolphin explore] calls a deadlock. *)
From Dolphin Require Export Invariants.

Section Progress.
  Context {L : Names} {C : Code}.

  (** What is active: no [|] without branches, and no choice of none. Residuals in normal form are [full]. *)
  Fixpoint full (r : residual) : bool :=
    match r with
    | Parallel rs => match rs with [] => false | _ => true end && forallb full rs
    | All_of bs | One_of bs => match bs with [] => false | _ => true end
    | Sequence r _ | Branch r _ | Until _ _ r | During _ _ _ r | Watch r _ | Repeat r _ _ _ | Holding _ r
    | Recruited _ r | Fresh _ r | Ensure r _ => full r
    | Ready _ _ | Running _ _ | Action _ | Condition _ | Idle _ _ | Confirm _ _ _ | During_code _ _ _ _ | Asked _ _ _
    | Made _ _ _ | Unallocated _ _ | Recruit _ _ _ _ _ => true
    end.

  (** What a residual awaits of the outside. *)
  Inductive awaited := Its_end (v : vehicle) | Its_expiry (i : timer) | Its_answer (i : timer) | Its_recruit (i : timer).

  Fixpoint awaits (r : residual) : list awaited :=
    match r with
    | Running _ v => [Its_end v]
    | Idle i _ => [Its_expiry i]
    | Confirm i _ _ => [Its_answer i]
    | Recruit i _ _ _ _ => [Its_recruit i]
    | During _ i _ r => Its_expiry i :: awaits r
    | Parallel rs => flat_map awaits rs
    | Sequence r _ | Branch r _ | Until _ _ r | Watch r _ | Repeat r _ _ _ | Holding _ r | Recruited _ r | Fresh _ r
    | Ensure r _ => awaits r
    | Ready _ _ | Action _ | Condition _ | All_of _ | One_of _ | During_code _ _ _ _ | Asked _ _ _ | Made _ _ _
    | Unallocated _ _ => []
    end.

  (** In a closed world no code is unclear. *)
  Definition closed_world : Prop :=
    (forall c ys w held S, run c ys w held S <> Unclear) /\
    (forall h m w held needed S, run_handler h m w held needed S <> Unclear_).

  (** A guard that is not [wanted] now has no step. *)
  Definition guard_waits (wanted : bool) (g : code) (K : context) (S : shared) : Prop :=
    match runs g [] K S with
    | Gives x _ _ _ => truth x <> Some wanted
    | Faulty m _ => is_unknown m = true
    | _ => False
    end.

  (** Neither outcome of a guard: what it asks is unknown. *)
  Definition guard_unknown (g : code) (K : context) (S : shared) : Prop :=
    match runs g [] K S with
    | Gives x _ _ _ => truth x = None
    | Faulty m _ => is_unknown m = true
    | _ => False
    end.

  Definition wanted (k : on_cut) : bool := match k with Completes => true | Fails _ => false end.

  (** Everything active is a guard that has no step, or a task that waits for vehicles that others hold. *)
  Inductive stuck : context -> shared -> residual -> Prop :=
  | K_condition : forall K S g, guard_waits true g K S -> stuck K S (Condition g)
  | K_all_of : forall K S bs, (forall b, In b bs -> guard_waits true (fst b) K S) -> stuck K S (All_of bs)
  | K_one_of : forall K S bs, (forall b, In b bs -> guard_waits true (fst b) K S) -> stuck K S (One_of bs)
  | K_asked : forall K S more g t, guard_unknown g K S -> stuck K S (Asked more g t)
  | K_unallocated : forall K S t q m x,
      alloc_made (world_of K) (held K) S (free K S) t q (taken_numbers K) = inr m ->
      alloc_made (world_of K) (held K) S (its_bound K S) t q (taken_numbers K) = inl x ->
      stuck K S (Unallocated t q)
  | K_until : forall K S k g r,
      guard_waits (wanted k) g K S -> stuck (enter (Body_until k g) K) S r -> stuck K S (Until k g r)
  | K_sequence : forall K S r t, stuck (enter (In_sequence t) K) S r -> stuck K S (Sequence r t)
  | K_parallel : forall K S rs,
      (forall b r a, rs = b ++ r :: a -> stuck (enter (Beside b a) K) S r) -> stuck K S (Parallel rs)
  | K_branch : forall K S r bs, stuck (enter (Branch_of bs) K) S r -> stuck K S (Branch r bs)
  | K_watch : forall K S r h, stuck (enter (In_watch h) K) S r -> stuck K S (Watch r h)
  | K_repeat : forall K S r more g t, stuck (enter (Round_of more g t) K) S r -> stuck K S (Repeat r more g t)
  | K_holding : forall K S vs r, stuck (enter (Held_by vs) K) S r -> stuck K S (Holding vs r)
  | K_recruited : forall K S v r, stuck (enter (In_recruited v) K) S r -> stuck K S (Recruited v r)
  | K_fresh : forall K S ks r, stuck (enter (With_keys ks) K) S r -> stuck K S (Fresh ks r)
  | K_ensure : forall K S r ds, stuck (enter (Ensuring ds) K) S r -> stuck K S (Ensure r ds).

  (** In a closed world what a part does is a step of the whole. *)
  Lemma lift_some f K t : closed_world -> lift f K t <> [].
  Proof.
    intros [_ Hh]. destruct t as [l S' [r | | m | x] E]; cbn; try discriminate.
    destruct f; cbn; try discriminate. unfold on_error.
    destruct (handles_error (handles h) m K S') as [x s gone N ds | m' ds | m' ds | m' s gone N ds |] eqn:R;
      try discriminate.
    - destruct x; [discriminate | discriminate | destruct (anew h) as [(u & q)|]; discriminate |].
      destruct (anew h) as [(u & q)|]; [|discriminate].
      destruct (deepest <=? depth q); discriminate.
    - exfalso. eapply Hh. exact R.
  Qed.

  Lemma some_of (X : Type) (l : list X) : l <> [] -> exists x, In x l.
  Proof. destruct l as [|x l]; [congruence | exists x; left; reflexivity]. Qed.

  Lemma inside_steps e f r K S :
    closed_world -> (exists t, goes e (enter f K) S r t) -> exists t, goes e K S (plug f r) t.
  Proof.
    intros Hc [t Ht]. destruct (some_of _ _ (lift_some f K t Hc)) as [t' Ht']. exists t'. eapply Within; eauto.
  Qed.

  Lemma guard_dec b g K S e holds fails faulty :
    closed_world -> e = None ->
    (forall s N ds, b = true -> holds s N ds <> []) -> (b = false -> fails <> []) -> (forall m ds, faulty m ds <> []) ->
    (exists t, In t (guarded e g K S holds fails faulty)) \/ guard_waits b g K S.
  Proof.
    intros [Hr _] -> Hh Hn Hf. unfold guarded, coded, guard_waits.
    destruct (runs g [] K S) as [x s N ds | m ds | m ds | m s N ds |] eqn:R.
    - destruct (truth x) as [[]|] eqn:T.
      + destruct b; [left; apply some_of; auto | right; discriminate].
      + destruct b; [right; discriminate | left; apply some_of; auto].
      + right. discriminate.
    - destruct (is_unknown m); [right; reflexivity | left; apply some_of; auto].
    - left. eexists. left. reflexivity.
    - left. eexists. left. reflexivity.
    - exfalso. eapply Hr. exact R.
  Qed.

  Lemma until_dec k g r K S :
    closed_world -> (exists t, goes None K S (Until k g r) t) \/ guard_waits (wanted k) g K S.
  Proof.
    intros Hc. assert (H : (exists t, In t (own None K S (Until k g r))) \/ guard_waits (wanted k) g K S).
    { cbn [own]. apply guard_dec; auto; destruct k; discriminate. }
    destruct H as [[t Ht] | Hw]; [left; exists t; apply Itself; exact Ht | right; exact Hw].
  Qed.

  Lemma coded_some c ys K S gives faulty :
    closed_world -> (forall x s N ds, gives x s N ds <> []) -> (forall m ds, faulty m ds <> []) ->
    exists t, In t (coded None c ys K S gives faulty).
  Proof.
    intros [Hr _] Hg Hf. apply some_of. unfold coded.
    destruct (runs c ys K S) as [x s N ds | m ds | m ds | m s N ds |] eqn:R; auto; try discriminate.
    exfalso. eapply Hr. exact R.
  Qed.

  Lemma branches_dec (bs : list branch) K S (f : list branch -> branch -> list branch -> list transition) :
    (forall b x a, (exists t, In t (f b x a)) \/ guard_waits true (fst x) K S) ->
    (exists t, In t (each f [] bs)) \/ (forall b, In b bs -> guard_waits true (fst b) K S).
  Proof.
    intros Hf.
    assert (H : forall before, (exists t, In t (each f before bs)) \/ (forall b, In b bs -> guard_waits true (fst b) K S)).
    { induction bs as [|b bs IH]; intros before; [right; intros b []|].
      destruct (Hf before b bs) as [[t Ht] | Hw].
      - left. exists t. cbn. apply in_app_iff. auto.
      - destruct (IH (before ++ [b])) as [[t Ht] | Hws].
        + left. exists t. cbn. apply in_app_iff. auto.
        + right. intros b' [<- | Hb']; auto. }
    apply H.
  Qed.

  Lemma parallel_dec rs K S :
    closed_world -> Forall (fun r => forall K, full r = true -> (exists t, goes None K S r t) \/ awaits r <> [] \/ stuck K S r) rs ->
    forallb full rs = true ->
    (exists t, goes None K S (Parallel rs) t) \/ awaits (Parallel rs) <> [] \/ stuck K S (Parallel rs).
  Proof.
    intros Hc HF HQ.
    assert (H : (exists t, goes None K S (Parallel rs) t) \/ awaits (Parallel rs) <> [] \/
                (forall b r a, rs = b ++ r :: a -> stuck (enter (Beside b a) K) S r)).
    { assert (G : forall pre post, rs = pre ++ post ->
        (exists t, goes None K S (Parallel rs) t) \/ awaits (Parallel rs) <> [] \/
        (forall b r a, post = b ++ r :: a -> stuck (enter (Beside (pre ++ b) a) K) S r)).
      { intros pre post. revert pre. induction post as [|q post IH]; intros pre Hrs.
        - right. right. intros b r a Hn. destruct b; discriminate.
        - destruct (IH (pre ++ [q])) as [Hs | [Ha | Hk]]; auto.
          { rewrite <- app_assoc. exact Hrs. }
          rewrite Forall_forall in HF. rewrite forallb_forall in HQ.
          assert (Hq : In q rs) by (rewrite Hrs; apply in_elt).
          destruct (HF q Hq (enter (Beside pre post) K) (HQ q Hq)) as [Hs | [Ha | Hk']].
          + left. rewrite Hrs. apply (inside_steps None (Beside pre post) q K S Hc Hs).
          + right. left. cbn. rewrite Hrs, flat_map_app. cbn. intros Hn.
            apply app_eq_nil in Hn. destruct Hn as [_ Hn]. apply app_eq_nil in Hn. tauto.
          + right. right. intros b r a Hp. destruct b as [|y b]; injection Hp as -> ->.
            * rewrite app_nil_r. exact Hk'.
            * specialize (Hk b r a eq_refl). rewrite <- app_assoc in Hk. exact Hk. }
      apply (G [] rs). reflexivity. }
    destruct H as [H | [H | H]]; auto. right. right. constructor. exact H.
  Qed.

  Theorem residuals_progress r : closed_world -> forall K S,
    full r = true ->
    (exists l S' o E, step None K S r l S' o E) \/ awaits r <> [] \/ stuck K S r.
  Proof.
    intros Hc.
    assert (H : forall K S, full r = true -> (exists t, goes None K S r t) \/ awaits r <> [] \/ stuck K S r).
    { induction r using residual_rect'; intros K S Q; cbn [full awaits] in *;
        try (right; left; discriminate);
        (* one part *)
        try match goal with
        | IH : forall K S, full ?r = true -> _ |- (exists t, goes None _ _ ?whole t) \/ _ =>
            match whole with
            | Sequence r ?t => pose (f := In_sequence t)
            | Branch r ?bs => pose (f := Branch_of bs)
            | Watch r ?h => pose (f := In_watch h)
            | Repeat r ?n ?g ?t => pose (f := Round_of n g t)
            | Holding ?vs r => pose (f := Held_by vs)
            | Recruited ?v r => pose (f := In_recruited v)
            | Fresh ?ks r => pose (f := With_keys ks)
            | Ensure r ?ds => pose (f := Ensuring ds)
            end;
            destruct (IH (enter f K) S Q) as [Hs | [Ha | Hk]];
            [left; apply (inside_steps None f r K S Hc Hs) | right; left; exact Ha | right; right; constructor; exact Hk]
        end.
      - left. eexists. apply Itself. left. reflexivity.
      - left. destruct (coded_some a [] K S (fun _ s N ds => [By (LAct ds) (with_code s N S) Ok (effects_of ds)]) (breaks S) Hc)
          as [t Ht]; [discriminate | discriminate |]. exists t. apply Itself. exact Ht.
      - destruct (guard_dec true g K S None (fun s N ds => [By (LCheck ds) (with_code s N S) Ok (effects_of ds)]) []
          (breaks S) Hc eq_refl) as [[t Ht] | Hw]; try discriminate.
        + left. exists t. apply Itself. exact Ht.
        + right. right. constructor. exact Hw.
      - apply andb_true_iff in Q. destruct Q as [_ Q]. apply parallel_dec; auto.
        rewrite Forall_forall in *. intros q Hq K' Hf. apply H; auto.
      - destruct (branches_dec bs K S (choose None K S (fun others r => branch_of r others))) as [[t Ht] | Hw].
        + intros b x a. unfold choose. apply guard_dec; auto; discriminate.
        + left. exists t. apply Itself. exact Ht.
        + right. right. constructor. exact Hw.
      - destruct (branches_dec bs K S (choose None K S (fun _ r => r))) as [[t Ht] | Hw].
        + intros b x a. unfold choose. apply guard_dec; auto; discriminate.
        + left. exists t. apply Itself. exact Ht.
        + right. right. constructor. exact Hw.
      - destruct (IHr (enter (Body_until k g) K) S Q) as [Hs | [Ha | Hk]].
        + left. apply (inside_steps None (Body_until k g) r K S Hc Hs).
        + right. left. exact Ha.
        + destruct (until_dec k g r K S Hc) as [[t Ht] | Hw].
          * left. exists t. exact Ht.
          * right. right. constructor; assumption.
      - left. destruct (coded_some d [] K S
          (fun x s N ds =>
             match time_of d x with
             | inl n => [By (LSet_time n) (clear (keys r) (with_code s N S)) (Next (During k i n r))
                           (effects_of ds ++ Set_timer i n :: begun r)]
             | inr m => breaks S m ds
             end) (breaks S) Hc) as [t Ht]; try discriminate.
        + intros x s N ds. destruct (time_of d x); discriminate.
        + exists t. apply Itself. exact Ht.
      - (* repeat(q) *)
        destruct Hc as [Hr _].
        destruct (runs g [] K S) as [x s N ds | m ds | m ds | m s N ds |] eqn:R.
        + destruct (truth x) as [[]|] eqn:T.
          * left. eexists. apply Itself. cbn. unfold guarded, coded. rewrite R, T. left. reflexivity.
          * left. eexists. apply Itself. cbn. unfold guarded, coded. rewrite R, T. left. reflexivity.
          * right. right. constructor. unfold guard_unknown. rewrite R. exact T.
        + destruct (is_unknown m) eqn:U.
          * right. right. constructor. unfold guard_unknown. rewrite R. exact U.
          * left. eexists. apply Itself. cbn. unfold guarded, coded. rewrite R, U. left. reflexivity.
        + left. eexists. apply Itself. cbn. unfold guarded, coded. rewrite R. left. reflexivity.
        + left. eexists. apply Itself. cbn. unfold guarded, coded. rewrite R. left. reflexivity.
        + exfalso. eapply Hr. exact R.
      - (* made *)
        left. destruct (coded_some a ys K S
          (fun x s N ds =>
             match made_task a ys q S x s ds with
             | Some t => [By LMake S (Next (Unallocated t (deeper q))) []]
             | None => let m := no_task a ys (depth q) (variables S) x s ds in [By (LBroken m) S (Err m) []]
             end) (breaks S) Hc) as [t Ht]; try discriminate.
        + intros x s N ds. destruct (made_task a ys q S x s ds); discriminate.
        + exists t. apply Itself. exact Ht.
      - (* unallocated *)
        destruct (alloc_made (world_of K) (held K) S (free K S) t q (taken_numbers K)) as [(vs & r)|m] eqn:Hf.
        + left. eexists. apply Itself. cbn. rewrite Hf. left. reflexivity.
        + destruct (alloc_made (world_of K) (held K) S (its_bound K S) t q (taken_numbers K)) as [x|m'] eqn:Hb.
          * right. right. econstructor; eauto.
          * left. eexists. apply Itself. cbn. rewrite Hf, Hb. left. reflexivity. }
    intros K S Q. destruct (H K S Q) as [[[l S' o E] Ht] | Hr]; [|auto].
    left. exists l, S', o, E. apply goes_iff_step. exact Ht.
  Qed.

  (** {1 What is stuck has no step, and awaits nothing} *)

  Lemma guard_waits_nothing b g K S e holds fails faulty :
    guard_waits b g K S ->
    (b = false -> forall s N ds, holds s N ds = []) -> (b = true -> fails = []) ->
    guarded e g K S holds fails faulty = [].
  Proof.
    unfold guard_waits, guarded, coded. intros Hw Hh Hn. destruct e; [reflexivity|].
    destruct (runs g [] K S) as [x s N ds | m ds | m ds | m s N ds |]; try contradiction.
    - destruct (truth x) as [[]|]; [..|reflexivity]; destruct b; auto; exfalso; auto.
    - rewrite Hw. reflexivity.
  Qed.

  Lemma each_nil (X Y : Type) (f : list X -> X -> list X -> list Y) xs :
    (forall b x a, In x xs -> f b x a = []) -> forall before, each f before xs = [].
  Proof.
    induction xs as [|x xs IH]; intros H before; [reflexivity|]. cbn. rewrite H by (left; reflexivity).
    apply IH. intros. apply H. right. assumption.
  Qed.

  Lemma stuck_has_no_step K S r : stuck K S r -> forall e t, ~ goes e K S r t.
  Proof.
    assert (One : forall f K S r, (forall e, own e K S (plug f r) = []) ->
      match f with Beside _ _ => False | _ => True end ->
      (forall e t, ~ goes e (enter f K) S r t) -> forall e t, ~ goes e K S (plug f r) t).
    { intros f K0 S0 r0 Ho Hf Hs e t Hg. inversion Hg as [? ? ? ? Hin | ? ? f' r' u ? Hg' Hin]; subst.
      - rewrite Ho in Hin. contradiction.
      - assert (Hp : In (f', r') (parts (plug f r0))) by (apply in_parts; symmetry; assumption).
        destruct f; cbn in Hp; try contradiction; destruct Hp as [Hp | []]; injection Hp as <- <-; eapply Hs; exact Hg'. }
    induction 1 as [K S g Hw | K S bs Hw | K S bs Hw | K S more g t Hw | K S t q m x Hf Hb | K S k g r Hw Hs IH
      | K S r t Hs IH | K S rs Hs IH | K S r bs Hs IH | K S r h Hs IH | K S r more g t Hs IH | K S vs r Hs IH
      | K S v r Hs IH | K S ks r Hs IH | K S r ds Hs IH]; intros e u.
    - intros Hg. apply goes_are_steps, steps_parts in Hg. destruct Hg as [Hg | (f & p & [] & _)]. cbn in Hg.
      rewrite (guard_waits_nothing true) in Hg; auto. discriminate.
    - intros Hg. apply goes_are_steps, steps_parts in Hg. destruct Hg as [Hg | (f & p & [] & _)]. cbn in Hg.
      rewrite each_nil in Hg; [exact Hg|]. intros b x a Hx. unfold choose.
      apply (guard_waits_nothing true); auto. discriminate.
    - intros Hg. apply goes_are_steps, steps_parts in Hg. destruct Hg as [Hg | (f & p & [] & _)]. cbn in Hg.
      rewrite each_nil in Hg; [exact Hg|]. intros b x a Hx. unfold choose.
      apply (guard_waits_nothing true); auto. discriminate.
    - intros Hg. apply goes_are_steps, steps_parts in Hg. destruct Hg as [Hg | (f & p & [] & _)]. cbn in Hg.
      unfold guarded, coded, guard_unknown in *. destruct e; [contradiction|].
      destruct (runs g [] K S) as [x s N ds | m ds | m ds | m s N ds |]; try contradiction; rewrite Hw in Hg; contradiction.
    - intros Hg. apply goes_are_steps, steps_parts in Hg. destruct Hg as [Hg | (f & p & [] & _)]. cbn in Hg.
      destruct e; [contradiction|]. rewrite Hf, Hb in Hg. contradiction.
    - apply (One (Body_until k g)); auto. intros e'. cbn. apply (guard_waits_nothing (wanted k)); auto;
        destruct k; cbn; intros; congruence.
    - apply (One (In_sequence t)); auto.
    - intros Hg. apply goes_are_steps, steps_parts in Hg. destruct Hg as [[] | (f & p & Hp & Hg)].
      apply in_parts in Hp. destruct f; cbn in Hp; try discriminate. injection Hp as ->.
      apply in_flat_map in Hg. destruct Hg as (t0 & Ht & _). apply steps_are_goes in Ht.
      eapply IH; [reflexivity | exact Ht].
    - apply (One (Branch_of bs)); auto.
    - apply (One (In_watch h)); auto.
    - apply (One (Round_of more g t)); auto.
    - apply (One (Held_by vs)); auto.
    - apply (One (In_recruited v)); auto.
    - apply (One (With_keys ks)); auto.
    - apply (One (Ensuring ds)); auto.
  Qed.

  Lemma stuck_awaits_nothing K S r : stuck K S r -> awaits r = [].
  Proof.
    induction 1; cbn; auto. apply flat_map_nil. intros r Hr. apply in_split in Hr. destruct Hr as (b & a & ->).
    eapply H0. reflexivity.
  Qed.

  (** A residual is a deadlock, without internal step and awaiting nothing, exactly if all that is active in it waits for
      guards or vehicles. *)
  Theorem deadlocks_wait_for_guards r K S :
    closed_world -> full r = true ->
    ((forall l S' o E, ~ step None K S r l S' o E) /\ awaits r = []) <-> stuck K S r.
  Proof.
    intros Hc Q. split.
    - intros [Hn Ha]. destruct (residuals_progress r Hc K S Q) as [(l & S' & o & E & Hs) | [H | H]]; auto.
      + exfalso. eapply Hn. exact Hs.
      + contradiction.
    - intros Hk. split; [|eapply stuck_awaits_nothing; exact Hk].
      intros l S' o E Hs. apply goes_iff_step in Hs. eapply stuck_has_no_step; eauto.
  Qed.
End Progress.
