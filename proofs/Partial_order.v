(** The partial order reduction of docs/explorer.md, on labelled transition systems: the conditions on the chosen steps
    are those of "What is chosen", the theorems those of "Why that is enough" and "Rounds and partial order". *)
From Dolphin Require Export Systems.
Set Implicit Arguments.
Unset Strict Implicit.

Section Partial_order.
  Variables state step : Type.

  (** [goes s a t]: step [a] leads from [s] to [t]. [breaks s a]: step [a] ends the run in [s], by an error, a fault, a
      failed assertion or [halt]. Nothing follows such a step, so it leads to no state. *)
  Variable goes : state -> step -> state -> Prop.
  Variable breaks : state -> step -> Prop.

  Variable conflict : step -> step -> Prop.
  Variable cuts : step -> step -> bool.        (* the first cuts off the component of the second *)
  Variable traceless : step -> Prop.           (* neither posts nor takes nor writes *)
  Variable last : step -> Prop.                (* ends its component *)
  Variable closes : step -> Prop.              (* begins a round of a repeat *)

  (** {1 What is relied on} *)

  (** Steps that do not conflict commute, and do not enable each other. *)
  Hypothesis commute : forall a t s s1 s2,
    ~ conflict a t -> cuts t a = false -> goes s a s1 -> goes s1 t s2 ->
    exists s1', goes s t s1' /\ goes s1' a s2.
  (** What is cut off later, and left no trace, might as well not have been. *)
  Hypothesis cut_off : forall a t s s1 s2,
    ~ conflict a t -> cuts t a = true -> traceless a -> goes s a s1 -> goes s1 t s2 -> goes s t s2.
  (** Steps that do not conflict leave each other possible, if none cuts off the other. *)
  Hypothesis stays : forall a k s s1 s2,
    ~ conflict a k -> cuts k a = false -> cuts a k = false -> goes s k s1 -> goes s a s2 ->
    exists s3, goes s1 a s3 /\ goes s2 k s3.
  (** A cut of the component of a step without trace may come after that step, with the same result; unless the step was
      the last one of its component, and the nest is over: then too with the same result, if the cut leaves no trace. *)
  Hypothesis cut_after : forall a k s s1 s2,
    ~ conflict a k -> cuts k a = false -> cuts a k = true -> traceless k -> (last k -> traceless a) ->
    goes s k s1 -> goes s a s2 -> goes s1 a s2 \/ (last k /\ s1 = s2).

  (** The same of steps that end the run. *)
  Hypothesis breaks_before : forall a t s s1,
    ~ conflict a t -> goes s a s1 -> breaks s1 t -> breaks s t.
  Hypothesis breaks_still : forall a k s s1,
    ~ conflict a k -> cuts k a = false -> goes s k s1 -> breaks s a -> breaks s1 a.

  (** A step that closes no round leaves less of the task. *)
  Variable size : Type.
  Variable less : size -> size -> Prop.
  Hypothesis less_founded : well_founded less.
  Variable size_of : state -> size.
  Hypothesis leaves_less : forall s a t, goes s a t -> ~ closes a -> less (size_of t) (size_of s).

  (** With symmetry an equal state is visited in place of the one that is reached; without, [equal] is equality. Steps
      are then the same up to names. *)
  Variable equal : state -> state -> Prop.
  Variable same : step -> step -> Prop.
  Hypothesis equal_refl : forall s, equal s s.
  Hypothesis equal_trans : forall s t u, equal s t -> equal t u -> equal s u.
  Hypothesis same_refl : forall a, same a a.
  Hypothesis same_trans : forall a b c, same a b -> same b c -> same a c.
  Hypothesis equal_bisimulation : bisimulation goes goes same equal.
  Hypothesis equal_breaks : forall s s' a, equal s s' -> breaks s a -> exists a', same a a' /\ breaks s' a'.
  Hypothesis equal_size : forall s s', equal s s' -> size_of s = size_of s'.

  (** {1 What is chosen} *)

  (** Runs without a step of a set. *)
  Inductive avoids (T : step -> bool) : state -> list step -> state -> Prop :=
  | Avoids_nil : forall s, avoids T s [] s
  | Avoids_step : forall s a s1 w t, T a = false -> goes s a s1 -> avoids T s1 w t -> avoids T s (a :: w) t.

  Definition possible (s : state) (a : step) : Prop := (exists t, goes s a t) \/ breaks s a.

  (** The steps that components outside of the set may ever do, as long as none of the set is done. *)
  Definition outside (T : step -> bool) (s : state) (a : step) : Prop :=
    T a = false /\ exists w t, avoids T s w t /\ possible t a.

  (** The steps that the chosen components have now are enough. *)
  Record enough (s : state) (T : step -> bool) : Prop := {
    no_conflict : forall a t, outside T s a -> T t = true -> ~ conflict a t;
    cut_in_set : forall a t, outside T s a -> T t = true -> cuts t a = true -> traceless a;
    has_key : exists k t, T k = true /\ goes s k t /\ (forall a, outside T s a -> cuts k a = false) /\
      (forall a, outside T s a -> cuts a k = true -> traceless k /\ (last k -> traceless a));
    closes_no_round : forall a t, T a = true -> goes s a t -> ~ closes a
  }.

  Variable chosen : state -> step -> bool.
  (** Otherwise all steps are followed. *)
  Hypothesis chosen_enough : forall s, (forall a, chosen s a = true) \/ enough s (chosen s).

  (** The visited states: for each chosen step, or one that is the same, a state equal to the one that it leads to. *)
  Variable visits : state -> step -> state -> Prop.
  Hypothesis visits_sound : forall s a u, visits s a u -> exists t, goes s a t /\ equal t u.
  Hypothesis visits_chosen : forall s a t,
    chosen s a = true -> goes s a t -> exists a' u, same a a' /\ visits s a' u /\ equal t u.

  (** {1 Steps to the front} *)

  Lemma outside_later T s a s1 b : T a = false -> goes s a s1 -> outside T s1 b -> outside T s b.
  Proof.
    intros Ta Hg (Tb & w & t & Hw & Hp). split; [exact Tb|]. exists (a :: w), t. split; [econstructor;
      eassumption | exact Hp].
  Qed.

  Lemma outside_now T s a : T a = false -> possible s a -> outside T s a.
  Proof. intros Ta Hp. split; [exact Ta|]. exists [], s. split; [constructor | exact Hp]. Qed.

  Lemma outside_end T s w t a : avoids T s w t -> T a = false -> possible t a -> outside T s a.
  Proof. intros Hw Ta Hp. split; [exact Ta|]. exists w, t. auto. Qed.

  Lemma avoids_run T s w t : avoids T s w t -> run goes s w t.
  Proof. induction 1; [constructor | econstructor; eassumption]. Qed.

  (** A run meets the set, or avoids it. *)
  Lemma meets_or_avoids T s w d : run goes s w d ->
    avoids T s w d \/
    exists u a v t t', w = u ++ a :: v /\ avoids T s u t /\ T a = true /\ goes t a t' /\ run goes t' v d.
  Proof.
    induction 1 as [s | s a s1 w d Hg Hr [IH | (u & b & v & t & t' & -> & Hu & Tb & Hb & Hv)]].
    - left. constructor.
    - destruct (T a) eqn:Ta.
      + right. exists [], a, w, s, s1. cbn. repeat split; try assumption. constructor.
      + left. econstructor; eassumption.
    - right. destruct (T a) eqn:Ta.
      + exists [], a, (u ++ b :: v), s, s1. cbn. repeat split; try assumption. constructor.
      + exists (a :: u), b, v, t, t'. cbn. repeat split; try assumption. econstructor; eassumption.
  Qed.

  (** The first step of the set in a run can come first. *)
  Lemma to_front T t s u s' : avoids T s u s' ->
    (forall a, outside T s a -> ~ conflict a t /\ (cuts t a = true -> traceless a)) -> forall s'', goes s' t s'' ->
    exists s1 u', goes s t s1 /\ run goes s1 u' s'' /\ length u' <= length u.
  Proof.
    induction 1 as [s | s a s1 w s' Ta Hg Hw IH]; intros Hout s'' Ht.
    - exists s'', []. split; [exact Ht | split; [constructor | cbn; lia]].
    - destruct (IH (fun b Hb => Hout b (outside_later Ta Hg Hb)) s'' Ht) as (s2 & u' & G & R & Hl).
      destruct (Hout a) as (Hc & Htr); [apply outside_now; [exact Ta | left; exists s1; exact Hg]|].
      destruct (cuts t a) eqn:Hcut.
      + exists s2, u'. split; [eapply cut_off; eauto | split; [exact R | cbn; lia]].
      + destruct (commute Hc Hcut Hg G) as (s1' & G1 & G2).
        exists s1', (a :: u'). split; [exact G1 | split; [econstructor; eassumption | cbn; lia]].
  Qed.

  (** A key can be put before a run without a step of the set; or the run itself does what it would do. *)
  Definition is_key (T : step -> bool) (s : state) (k : step) : Prop :=
    (forall a, outside T s a -> ~ conflict a k) /\ (forall a, outside T s a -> cuts k a = false) /\
    (forall a, outside T s a -> cuts a k = true -> traceless k /\ (last k -> traceless a)).

  Lemma key_later T s k a s1 : T a = false -> goes s a s1 -> is_key T s k -> is_key T s1 k.
  Proof.
    intros Ta Hg (K1 & K2 & K3).
    split; [|split]; intros b Hb; [apply K1 | apply K2 | apply K3]; eapply outside_later; eassumption.
  Qed.

  Lemma key_first T s w d : avoids T s w d -> forall k s1, is_key T s k -> goes s k s1 ->
    (exists d', run goes s1 w d' /\ goes d k d') \/ (exists w', run goes s1 w' d /\ length w' <= length w).
  Proof.
    induction 1 as [s | s a sa w d Ta Hg Hw IH]; intros k s1 HK Hk.
    - left. exists s1. split; [constructor | exact Hk].
    - assert (Hout : outside T s a) by (apply outside_now; [exact Ta | left; exists sa; exact Hg]).
      pose proof HK as (K1 & K2 & K3). destruct (cuts a k) eqn:Hcut.
      + destruct (K3 a Hout Hcut) as (Htr & Hla).
        destruct (cut_after (K1 a Hout) (K2 a Hout) Hcut Htr Hla Hk Hg) as [G | (_ & ->)].
        * right. exists (a :: w). split; [econstructor; [exact G | eapply avoids_run; exact Hw] | cbn; lia].
        * right. exists w. split; [eapply avoids_run; exact Hw | cbn; lia].
      + destruct (stays (K1 a Hout) (K2 a Hout) Hcut Hk Hg) as (s3 & G1 & G2).
        destruct (IH k s3 (key_later Ta Hg HK) G2) as [(d' & R & G) | (w' & R & Hl)].
        * left. exists d'. split; [econstructor; eassumption | exact G].
        * right. exists (a :: w'). split; [econstructor; eassumption | cbn; lia].
  Qed.

  Lemma enough_key s T : enough s T -> exists k t, T k = true /\ goes s k t /\ ~ closes k /\ is_key T s k.
  Proof.
    intros [H1 H2 (k & t & Tk & Hk & K2 & K3) H4]. exists k, t.
    split; [exact Tk | split; [exact Hk | split; [eapply H4; eassumption|]]].
    split; [intros a Ha; apply H1; assumption | split; assumption].
  Qed.

  Lemma enough_front s T t : enough s T -> T t = true ->
    forall a, outside T s a -> ~ conflict a t /\ (cuts t a = true -> traceless a).
  Proof. intros H Tt a Ha. split; [eapply no_conflict; eauto | eapply cut_in_set; eauto]. Qed.

  (** {1 What is kept} *)

  (** Induction on the length of the run, and within that on the size of the task. *)
  Lemma by_length_and_size (P : state -> list step -> state -> Prop) :
    (forall s w d,
       (forall s' w' d', run goes s' w' d' ->
          length w' < length w \/ (length w' <= length w /\ less (size_of s') (size_of s)) -> P s' w' d') ->
       run goes s w d -> P s w d) ->
    forall s w d, run goes s w d -> P s w d.
  Proof.
    intros Step.
    assert (All : forall n s w d, length w <= n -> run goes s w d -> P s w d).
    { induction n as [n IHn] using lt_wf_ind. intros s.
      remember (size_of s) as x eqn:Hx. revert s Hx. induction (less_founded x) as [x _ IHx].
      intros s -> w d Hn Hr. apply Step; [|exact Hr]. intros s' w' d' Hr' [Hl | (Hl & Hs)].
      - eapply IHn; [|reflexivity | exact Hr']. lia.
      - eapply IHx; [exact Hs | reflexivity | lia | exact Hr']. }
    intros s w d Hr. eapply All; [reflexivity | exact Hr].
  Qed.

  (** A run after a step that is followed, from the state that is visited. *)
  Lemma onward s a t w d : chosen s a = true -> goes s a t -> run goes t w d ->
    exists a' u w' d', visits s a' u /\ equal t u /\ run goes u w' d' /\ length w' = length w /\ equal d d' /\
      same a a'.
  Proof.
    intros Ha Hg Hr. destruct (visits_chosen Ha Hg) as (a' & u & Hs & V & E).
    destruct (bisimilar_runs equal_bisimulation Hr E) as (w' & d' & Hw & Hr' & Ed).
    exists a', u, w', d'. repeat split; try assumption. symmetry. eapply Forall2_length. exact Hw.
  Qed.

  (** Each deadlock, and each state with which a task ends, is reached. *)
  Theorem rests_are_kept : forall s w d, run goes s w d -> at_rest goes d ->
    exists w' d', run visits s w' d' /\ equal d d'.
  Proof.
    apply (@by_length_and_size (fun s w d => at_rest goes d -> exists w' d', run visits s w' d' /\ equal d d')).
    intros s w d IH Hr Hd.
    (* after a step that is followed *)
    assert (Go : forall a t v, chosen s a = true -> goes s a t -> run goes t v d ->
                   length v < length w \/ (length v <= length w /\ less (size_of t) (size_of s)) ->
                   exists w' d', run visits s w' d' /\ equal d d').
    { intros a t v Ha Hg Hv Hl. destruct (onward Ha Hg Hv) as (a' & u & w' & d' & V & E & R & Hw & Ed & _).
      destruct (IH u w' d' R) as (w2 & d2 & R2 & E2).
      - rewrite Hw, <- (equal_size E). exact Hl.
      - apply (bisimilar_rest equal_bisimulation Ed). exact Hd.
      - exists (a' :: w2), d2. split; [econstructor; eassumption | eapply equal_trans; eassumption]. }
    destruct (chosen_enough s) as [All | En].
    - destruct Hr as [s | s a s1 w d Hg Hr].
      + exists [], s. split; [constructor | apply equal_refl].
      + eapply Go; [apply All | exact Hg | exact Hr |]. left. cbn. lia.
    - destruct (meets_or_avoids (chosen s) Hr) as [Hav | (u & a & v & t & t' & -> & Hu & Ta & Hg & Hv)].
      + destruct (enough_key En) as (k & s1 & Tk & Hk & Hc & HK).
        destruct (key_first Hav HK Hk) as [(d' & _ & G) | (w' & R & Hl)].
        * exfalso. exact (Hd _ _ G).
        * eapply Go; [exact Tk | exact Hk | exact R |]. right. split; [exact Hl | eapply leaves_less; eassumption].
      + destruct (to_front Hu (enough_front En Ta) Hg) as (s1 & u' & G & R & Hl).
        eapply Go; [exact Ta | exact G | exact (run_app R Hv) |]. left. rewrite !app_length. cbn. lia.
  Qed.

  (** Conversely, what is visited is equal to a state that is reached; so a deadlock that is found is one. *)
  Theorem visited_is_reached : forall s w d, run visits s w d -> exists w' d', run goes s w' d' /\ equal d' d.
  Proof.
    induction 1 as [s | s a u w d V _ (w' & d' & R & E)].
    - exists [], s. split; [constructor | apply equal_refl].
    - destruct (visits_sound V) as (t & G & Et).
      destruct (bisimilar_runs_back equal_bisimulation R Et) as (w2 & d2 & _ & R2 & E2).
      exists (a :: w2), d2. split; [econstructor; eassumption | eapply equal_trans; eassumption].
  Qed.

  Lemma breaks_in_front T f s w d : avoids T s w d ->
    (forall a, outside T s a -> ~ conflict a f) -> breaks d f -> breaks s f.
  Proof.
    induction 1 as [s | s a s1 w d Ta Hg Hw IH]; intros Hout Hf; [exact Hf|].
    eapply breaks_before; [apply Hout, outside_now; [exact Ta | left; exists s1; exact Hg] | exact Hg |].
    apply IH; [|exact Hf]. intros b Hb. apply Hout. eapply outside_later; eassumption.
  Qed.

  (** Each step that can end the run (an unhandled error, a fault, a failed assertion, [halt]) is possible in some state
      that is visited. There all of them are followed. *)
  Theorem breaks_are_kept : forall s w d, run goes s w d -> forall f, breaks d f ->
    exists w' d' f', run visits s w' d' /\ same f f' /\ breaks d' f'.
  Proof.
    apply (@by_length_and_size (fun s w d => forall f, breaks d f ->
      exists w' d' f', run visits s w' d' /\ same f f' /\ breaks d' f')).
    intros s w d IH Hr f Hf.
    assert (Go : forall a t v d1, chosen s a = true -> goes s a t -> run goes t v d1 -> breaks d1 f ->
                   length v < length w \/ (length v <= length w /\ less (size_of t) (size_of s)) ->
                   exists w' d' f', run visits s w' d' /\ same f f' /\ breaks d' f').
    { intros a t v d1 Ha Hg Hv Hf1 Hl. destruct (onward Ha Hg Hv) as (a' & u & w' & d' & V & E & R & Hw & Ed & _).
      destruct (equal_breaks Ed Hf1) as (f1 & Sf & Hf').
      destruct (IH u w' d' R) with (f := f1) as (w2 & d2 & f2 & R2 & S2 & F2).
      - rewrite Hw, <- (equal_size E). exact Hl.
      - exact Hf'.
      - exists (a' :: w2), d2, f2. split; [econstructor; eassumption | split; [eapply same_trans;
        eassumption | exact F2]]. }
    destruct (chosen_enough s) as [All | En].
    - destruct Hr as [s | s a s1 w d Hg Hr].
      + exists [], s, f. split; [constructor | split; [apply same_refl | exact Hf]].
      + eapply Go; [apply All | exact Hg | exact Hr | exact Hf |]. left. cbn. lia.
    - destruct (meets_or_avoids (chosen s) Hr) as [Hav | (u & a & v & t & t' & -> & Hu & Ta & Hg & Hv)].
      + destruct (chosen s f) eqn:Tf.
        * exists [], s, f. split; [constructor | split; [apply same_refl|]].
          eapply breaks_in_front; [exact Hav | | exact Hf]. intros a Ha. eapply no_conflict; eassumption.
        * assert (Of : outside (chosen s) s f) by (eapply outside_end; [exact Hav | exact Tf | right; exact Hf]).
          destruct (enough_key En) as (k & s1 & Tk & Hk & Hc & HK). pose proof HK as (K1 & K2 & K3).
          destruct (key_first Hav HK Hk) as [(d' & R & G) | (w' & R & Hl)].
          -- eapply Go; [exact Tk | exact Hk | exact R | eapply breaks_still; eauto |].
             right. split; [lia | eapply leaves_less; eassumption].
          -- eapply Go; [exact Tk | exact Hk | exact R | exact Hf |].
             right. split; [exact Hl | eapply leaves_less; eassumption].
      + destruct (to_front Hu (enough_front En Ta) Hg) as (s1 & u' & G & R & Hl).
        eapply Go; [exact Ta | exact G | exact (run_app R Hv) | exact Hf |]. left. rewrite !app_length. cbn. lia.
  Qed.

  (** A cut without a trace of what may be over already. *)
  Definition overtaken (a : step) : Prop := traceless a /\ exists k, cuts a k = true /\ last k.
  Hypothesis same_overtaken : forall a b, same a b -> overtaken b -> overtaken a.

  (** Each step that some run takes is taken;
    but perhaps not a cut without a trace, if the nest may be over before it. *)
  Theorem steps_are_kept : forall s w d, run goes s w d -> forall a t, goes d a t -> ~ overtaken a ->
    exists w' d' a' u, run visits s w' d' /\ same a a' /\ visits d' a' u.
  Proof.
    apply (@by_length_and_size (fun s w d => forall a t, goes d a t -> ~ overtaken a ->
      exists w' d' a' u, run visits s w' d' /\ same a a' /\ visits d' a' u)).
    intros s w d IH Hr a t Ha Hov.
    assert (Now : forall t, chosen s a = true -> goes s a t ->
                    exists w' d' a' u, run visits s w' d' /\ same a a' /\ visits d' a' u).
    { intros t1 Tc Hg. destruct (visits_chosen Tc Hg) as (a' & u & Hs & V & _).
      exists [], s, a', u. split; [constructor | auto]. }
    assert (Go : forall b t v d1 t1, chosen s b = true -> goes s b t -> run goes t v d1 -> goes d1 a t1 ->
                   length v < length w \/ (length v <= length w /\ less (size_of t) (size_of s)) ->
                   exists w' d' a' u, run visits s w' d' /\ same a a' /\ visits d' a' u).
    { intros b t0 v d1 t1 Tb Hg Hv Ha1 Hl. destruct (onward Tb Hg Hv) as (b' & u & w' & d' & V & E & R & Hw & Ed & _).
      destruct (forth equal_bisimulation Ed Ha1) as (a1 & t2 & Sa & Ga & _).
      destruct (IH u w' d' R) with (a := a1) (t := t2) as (w2 & d2 & a2 & u2 & R2 & S2 & V2).
      - rewrite Hw, <- (equal_size E). exact Hl.
      - exact Ga.
      - intros H. apply Hov. eapply same_overtaken; eassumption.
      - exists (b' :: w2), d2, a2, u2.
        split; [econstructor; eassumption | split; [eapply same_trans; eassumption | exact V2]]. }
    destruct (chosen_enough s) as [All | En].
    - destruct Hr as [s | s b s1 w d Hg Hr].
      + eapply Now; [apply All | exact Ha].
      + eapply Go; [apply All | exact Hg | exact Hr | exact Ha |]. left. cbn. lia.
    - destruct (meets_or_avoids (chosen s) Hr) as [Hav | (u & b & v & t1 & t' & -> & Hu & Tb & Hg & Hv)].
      + destruct (chosen s a) eqn:Tc.
        * destruct (to_front Hav (enough_front En Tc) Ha) as (s1 & u' & G & _ & _). exact (Now s1 eq_refl G).
        * assert (Oa : outside (chosen s) s a)
            by (eapply outside_end; [exact Hav | exact Tc | left; exists t; exact Ha]).
          destruct (enough_key En) as (k & s1 & Tk & Hk & Hc & HK). pose proof HK as (K1 & K2 & K3).
          destruct (key_first Hav HK Hk) as [(d' & R & G) | (w' & R & Hl)].
          -- assert (Still : exists t', goes d' a t').
             { destruct (cuts a k) eqn:Hcut.
               - destruct (K3 a Oa Hcut) as (Htr & Hla).
                 destruct (cut_after (K1 a Oa) (K2 a Oa) Hcut Htr Hla G Ha) as [G' | (Hlast & _)].
                 + exists t. exact G'.
                 + exfalso. apply Hov. split; [exact (Hla Hlast) | exists k; auto].
               - destruct (stays (K1 a Oa) (K2 a Oa) Hcut G Ha) as (s3 & G' & _). exists s3. exact G'. }
             destruct Still as (t' & Ht').
             eapply Go; [exact Tk | exact Hk | exact R | exact Ht' |].
             right. split; [lia | eapply leaves_less; eassumption].
          -- eapply Go; [exact Tk | exact Hk | exact R | exact Ha |].
             right. split; [exact Hl | eapply leaves_less; eassumption].
      + destruct (to_front Hu (enough_front En Tb) Hg) as (s1 & u' & G & R & Hl).
        eapply Go; [exact Tb | exact G | exact (run_app R Hv) | exact Ha |]. left. rewrite !app_length. cbn. lia.
  Qed.

  (** {1 Termination} *)

  CoInductive avoids_without_end (T : step -> bool) : state -> Prop :=
  | Avoids_on : forall s a t, T a = false -> goes s a t -> avoids_without_end T t -> avoids_without_end T s.

  Definition meets (T : step -> bool) (s : state) : Prop :=
    exists u a t t', avoids T s u t /\ T a = true /\ goes t a t' /\ endless goes t'.

  Lemma never_meets T : forall s, ~ meets T s -> endless goes s -> avoids_without_end T s.
  Proof.
    cofix go. intros s Hm H. destruct H as [s a t Hg Ht]. destruct (T a) eqn:Ta.
    - exfalso. apply Hm. exists [], a, s, t. split; [constructor | auto].
    - apply (Avoids_on Ta Hg). apply go; [|exact Ht]. intros (u & b & t1 & t' & Hu & Rest).
      apply Hm. exists (a :: u), b, t1, t'. split; [econstructor; eassumption | exact Rest].
  Qed.

  Lemma avoids_endless T : forall s, avoids_without_end T s -> endless goes s.
  Proof. cofix go. intros s H. destruct H as [s a t _ Hg Ht]. exact (Endless Hg (go _ Ht)). Qed.

  Lemma key_first_endless T : forall s k s1, is_key T s k -> goes s k s1 -> avoids_without_end T s -> endless goes s1.
  Proof.
    cofix go. intros s k s1 HK Hk H. destruct H as [s a t Ta Hg Ht].
    assert (Hout : outside T s a) by (apply outside_now; [exact Ta | left; exists t; exact Hg]).
    pose proof HK as (K1 & K2 & K3). destruct (cuts a k) eqn:Hcut.
    - destruct (K3 a Hout Hcut) as (Htr & Hla).
      destruct (cut_after (K1 a Hout) (K2 a Hout) Hcut Htr Hla Hk Hg) as [G | (_ & ->)].
      + exact (Endless G (avoids_endless Ht)).
      + exact (avoids_endless Ht).
    - destruct (stays (K1 a Hout) (K2 a Hout) Hcut Hk Hg) as (s3 & G1 & G2).
      apply (Endless G1). exact (go _ _ _ (key_later Ta Hg HK) G2 Ht).
  Qed.

  (** If all runs that are followed end, all runs do. *)
  Theorem termination_is_kept s : terminates visits s -> endless goes s -> False.
  Proof.
    induction 1 as [s _ IH]. intros H.
    assert (Go : forall a t, chosen s a = true -> goes s a t -> endless goes t -> False).
    { intros a t Ha Hg Ht. destruct (visits_chosen Ha Hg) as (a' & u & _ & V & E).
      apply (IH u); [exists a'; exact V | exact (bisimilar_endless equal_bisimulation E Ht)]. }
    destruct (chosen_enough s) as [All | En].
    - destruct H as [s a t Hg Ht]. exact (Go a t (All a) Hg Ht).
    - assert (No : ~ meets (chosen s) s).
      { intros (u & a & t & t' & Hu & Ta & Hg & Ht).
        destruct (to_front Hu (enough_front En Ta) Hg) as (s1 & u' & G & R & _).
        apply (Go a s1 Ta G). clear - R Ht. induction R; [exact Ht | econstructor; eauto]. }
      destruct (enough_key En) as (k & s1 & Tk & Hk & _ & HK).
      exact (Go k s1 Tk Hk (key_first_endless HK Hk (never_meets No H))).
  Qed.

  (** And conversely. *)
  Theorem visited_terminates s : terminates goes s -> forall s', equal s s' -> terminates visits s'.
  Proof.
    induction 1 as [s _ IH]. intros s' E. constructor. intros u (a & V).
    destruct (visits_sound V) as (t & G & Et). destruct (back equal_bisimulation E G) as (b & t0 & _ & G0 & E0).
    apply (IH t0); [exists b; exact G0 | eapply equal_trans; eassumption].
  Qed.
End Partial_order.

(** The conditions can be met: of two components with one step each, one step at a time is enough. *)
Module Two_components.
  Definition state : Type := bool * bool.
  Inductive goes : state -> bool -> state -> Prop :=
  | Left : forall b, goes (false, b) true (true, b)
  | Right : forall b, goes (b, false) false (b, true).
  Definition chosen (s : state) (a : bool) : bool := if fst s then true else a.
  Definition visits (s : state) (a : bool) (t : state) : Prop := chosen s a = true /\ goes s a t.
  Definition weight (s : state) : nat := (if fst s then 0 else 1) + (if snd s then 0 else 1).

  Lemma chosen_enough s :
    (forall a, chosen s a = true) \/
    enough goes (fun _ _ => False) eq (fun _ _ => false) (fun _ => True) (fun _ => True) (fun _ => False) s (chosen s).
  Proof.
    destruct s as [[] b]; [left; reflexivity|]. right. split; try tauto; try discriminate.
    - intros a t (Ha & _) Ht ->. congruence.
    - exists true, (true, b). repeat split; try discriminate. constructor.
  Qed.

  Example one_order : exists w d, run visits (false, false) w d /\ (true, true) = d.
  Proof.
    refine (@rests_are_kept _ _ goes (fun _ _ => False) eq (fun _ _ => false) (fun _ => True)
      (fun _ => True) (fun _ => False) _ _ _ _ _ lt lt_wf weight _ eq eq _ _ _ _ chosen chosen_enough visits _
      (false, false) [false; true] (true, true) _ _); try discriminate; try congruence.
    - intros a t s s1 s2 Hc _ H1 H2.
      inversion H1; subst; inversion H2; subst; try (exfalso; apply Hc; reflexivity); eexists; split; constructor.
    - intros a k s s1 s2 Hc _ _ H1 H2.
      inversion H1; subst; inversion H2; subst; try (exfalso; apply Hc; reflexivity); eexists; split; constructor.
    - intros s a t Hg _. inversion Hg; subst; cbn; lia.
    - split; intros s s' a t -> Hg; exists a, t; auto.
    - intros s a t Hc Hg. exists a, t. unfold visits. auto.
    - repeat econstructor.
    - intros l t H. inversion H.
  Qed.
End Two_components.
