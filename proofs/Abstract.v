(** spec/Abstract.tla: the vehicles that a program holds, their tasks, and the tuple space, without the reasons for
    events; and its theorems. Functions and bags are equal here if they agree everywhere. *)
From Dolphin Require Export Metavariables.
From Coq Require Import Permutation.

Section Abstract.
  Context {L : Names}.

  Definition pair_of : Type := (key * value)%type.

  Record abstract := {
    tasks : vehicle -> option plan;            (* A *)
    holds : vehicle -> bool;                   (* B *)
    bag : list pair_of;                        (* N, in any order *)
    over : bool
  }.

  Definition same (s s' : abstract) : Prop :=
    (forall v, tasks s v = tasks s' v) /\ (forall v, holds s v = holds s' v) /\
    Permutation (bag s) (bag s') /\ over s = over s'.

  Inductive abstract_event :=
  | ABind (v : vehicle) | ARelease (v : vehicle) | AStart (v : vehicle) (p : plan) | AEnd (v : vehicle)
  | AStop (v : vehicle) | APost (x : pair_of) | AConsume (x : pair_of) | AFinish.

  (** {1 Events} *)

  Definition same_tasks (s s' : abstract) := forall v, tasks s' v = tasks s v.
  Definition same_held (s s' : abstract) := forall v, holds s' v = holds s v.
  Definition same_bag (s s' : abstract) := Permutation (bag s) (bag s').
  Definition idle (s : abstract) (v : vehicle) : Prop := holds s v = true /\ tasks s v = None.

  Definition is_now {X : Type} (f f' : vehicle -> X) (v : vehicle) (x : X) : Prop :=
    forall u, f' u = if vehicle_eq u v then x else f u.

  Definition happens (e : abstract_event) (s s' : abstract) : Prop :=
    over s = false /\
    match e with
    | ABind v => holds s v = false /\ is_now (holds s) (holds s') v true /\ same_tasks s s' /\ same_bag s s' /\
        over s' = false
    | ARelease v => idle s v /\ is_now (holds s) (holds s') v false /\ same_tasks s s' /\ same_bag s s' /\
        over s' = false
    | AStart v p => idle s v /\ is_now (tasks s) (tasks s') v (Some p) /\ same_held s s' /\ same_bag s s' /\
        over s' = false
    | AEnd v | AStop v => tasks s v <> None /\ is_now (tasks s) (tasks s') v None /\ same_held s s' /\ same_bag s s' /\
        over s' = false
    | APost x => Permutation (bag s') (x :: bag s) /\ same_tasks s s' /\ same_held s s' /\ over s' = false
    | AConsume x => Permutation (bag s) (x :: bag s') /\ same_tasks s s' /\ same_held s s' /\ over s' = false
    | AFinish => (forall v, holds s v = false) /\ same_tasks s s' /\ same_held s s' /\ same_bag s s' /\ over s' = true
    end.

  Definition next (s s' : abstract) : Prop := same s s' \/ exists e, happens e s s'.

  Definition at_first (s : abstract) : Prop :=
    (forall v, tasks s v = None) /\ (forall v, holds s v = false) /\ bag s = [] /\ over s = false.

  (** {1 Invariants} *)

  Definition allocation_within_bound (s : abstract) : Prop := forall v, tasks s v <> None -> holds s v = true.
  Definition empty_after_end (s : abstract) : Prop :=
    over s = true -> (forall v, tasks s v = None) /\ (forall v, holds s v = false).
  Definition abstract_inv (s : abstract) : Prop := allocation_within_bound s /\ empty_after_end s.

  Theorem inv_at_first s : at_first s -> abstract_inv s.
  Proof. intros (A & B & _ & _). split; [intros v H; rewrite A in H; congruence | intros _; auto]. Qed.

  Theorem inv_is_kept s s' : abstract_inv s -> next s s' -> abstract_inv s'.
  Proof.
    intros [H1 H2] [(A & B & _ & O) | (e & Ho & He)].
    - split; [intros v; rewrite <- A, <- B; apply H1 | unfold empty_after_end; rewrite <- O; intros H].
      destruct (H2 H) as [HA HB]. split; intros v; [rewrite <- A | rewrite <- B]; auto.
    - assert (G : allocation_within_bound s').
      { unfold allocation_within_bound, same_tasks, same_held, is_now, idle in *.
        destruct e; intros u; specialize (H1 u); try (destruct He as (P & A & B & _)).
        - rewrite (A u), (B u). intros Hu. destruct (vehicle_eq u v); auto.
        - rewrite (A u), (B u). intros Hu. destruct (vehicle_eq u v) as [->|]; [|auto]. destruct P; congruence.
        - rewrite (A u), (B u). destruct (vehicle_eq u v) as [->|]; [|auto]. intros _. apply P.
        - rewrite (A u), (B u). destruct (vehicle_eq u v) as [->|]; [congruence | auto].
        - rewrite (A u), (B u). destruct (vehicle_eq u v) as [->|]; [congruence | auto].
        - rewrite (A u), (B u). exact H1.
        - rewrite (A u), (B u). exact H1.
        - rewrite (A u), (B u). exact H1. }
      split; [exact G|]. intros Hover.
      destruct e; repeat match goal with H : _ /\ _ |- _ => destruct H end; try congruence.
      rename H into P. match goal with H : same_held s s' |- _ => rename H into B end.
      assert (Hh : forall v, holds s' v = false) by (intros v; rewrite (B v); apply P).
      split; [|exact Hh]. intros v. destruct (tasks s' v) eqn:T; [|reflexivity]. exfalso.
      assert (Hv : holds s' v = true) by (apply G; congruence). rewrite Hh in Hv. discriminate.
  Qed.

  Inductive behaviour : abstract -> Prop :=
  | Starts : forall s, at_first s -> behaviour s
  | Goes_on : forall s s', behaviour s -> next s s' -> behaviour s'.

  Theorem invariance s : behaviour s -> abstract_inv s.
  Proof. induction 1; [apply inv_at_first; assumption | eapply inv_is_kept; eassumption]. Qed.

  (** After the end no event follows; a vehicle gets another task only when it has none; and each pair of N was posted,
      one pair by one event. *)
  Theorem abstract_steps s s' :
    next s s' ->
    (over s = true -> same s s') /\
    (forall v p p', tasks s v = Some p -> tasks s' v = Some p' -> p' = p) /\
    (Permutation (bag s) (bag s') \/ exists x, Permutation (bag s') (x :: bag s) \/ Permutation (bag s) (x :: bag s')).
  Proof.
    intros [H | (e & Ho & He)].
    - destruct H as (A & B & P & O). split; [unfold same; auto | split; [|auto]].
      intros v p p' Hp Hp'. rewrite A in Hp. congruence.
    - split; [congruence|]. unfold same_tasks, same_held, same_bag, is_now, idle in *.
      destruct e; (destruct He as (P & A & B & C')); (split;
        [intros u p0 p' Hp Hp'; try (rewrite (B u) in Hp'; congruence); try (rewrite (A u) in Hp'; congruence);
         try (rewrite (A u) in Hp'; destruct (vehicle_eq u v) as [->|]; [|congruence]; destruct P; congruence)
        | try (left; apply C'; fail); try (right; exists x; auto; fail)]).
  Qed.

  (** {1 Runs} *)

  Inductive happen : list abstract_event -> abstract -> abstract -> Prop :=
  | Nothing_happens : forall s s', same s s' -> happen [] s s'
  | One_happens : forall e es s s1 s', happens e s s1 -> happen es s1 s' -> happen (e :: es) s s'.

  Lemma same_refl s : same s s. Proof. unfold same. auto. Qed.

  Lemma same_trans s s1 s2 : same s s1 -> same s1 s2 -> same s s2.
  Proof.
    intros (A & B & P & O) (A' & B' & P' & O').
    split; [congruence | split; [congruence | split; [eapply Permutation_trans; eassumption | congruence]]].
  Qed.

  Lemma same_happens e s s1 s' : same s s1 -> happens e s1 s' -> happens e s s'.
  Proof.
    intros (A & B & P & O) [Ho He]. split; [congruence|].
    unfold same_tasks, same_held, same_bag, is_now, idle in *.
    destruct e; repeat match goal with H : _ /\ _ |- _ => destruct H end;
      repeat split; intros; rewrite ?A, ?B in *; auto;
      try (eapply Permutation_trans; [exact P | assumption]; fail).
    - eapply Permutation_trans; [eassumption|]. apply perm_skip, Permutation_sym, P.
  Qed.

  Lemma same_happen es s s1 s' : same s s1 -> happen es s1 s' -> happen es s s'.
  Proof.
    intros H Hs. destruct Hs as [s1 s' H' | e es s1 s2 s' He Hs].
    - constructor. eapply same_trans; eassumption.
    - econstructor; [eapply same_happens; eassumption | exact Hs].
  Qed.

  Lemma happen_app es es' s s1 s' : happen es s s1 -> happen es' s1 s' -> happen (es ++ es') s s'.
  Proof.
    induction 1 as [s s1 H | e es s s2 s1 He Hs IH]; intros H'; cbn.
    - eapply same_happen; eassumption.
    - econstructor; [exact He | apply IH; exact H'].
  Qed.

  (** {1 One vehicle} *)

  Inductive vehicle_state := Out | Idle_ | Runs (p : plan).
  Inductive vehicle_event := VBind | VRelease | VStart (p : plan) | VEnd.

  Definition vstep (s : vehicle_state) (e : vehicle_event) : option vehicle_state :=
    match s, e with
    | Out, VBind => Some Idle_
    | Idle_, VRelease => Some Out
    | Idle_, VStart p => Some (Runs p)
    | Runs _, VEnd => Some Idle_
    | _, _ => None
    end.

  Fixpoint vrun (es : list vehicle_event) (s : vehicle_state) : option vehicle_state :=
    match es with [] => Some s | e :: es => match vstep s e with Some s' => vrun es s' | None => None end end.

  Lemma vrun_app a b s : vrun (a ++ b) s = match vrun a s with Some s' => vrun b s' | None => None end.
  Proof. revert s. induction a as [|e a IH]; intros s; cbn; [reflexivity|]. destruct (vstep s e); auto. Qed.

  Definition st (a : option plan) (h : bool) : vehicle_state :=
    match a with Some p => Runs p | None => if h then Idle_ else Out end.

  Definition state_of (s : abstract) (v : vehicle) : vehicle_state := st (tasks s v) (holds s v).

  (** The events of one vehicle among [es]. *)
  Definition of_vehicle (v : vehicle) (e : abstract_event) : list vehicle_event :=
    match e with
    | ABind u => if vehicle_eq u v then [VBind] else []
    | ARelease u => if vehicle_eq u v then [VRelease] else []
    | AStart u p => if vehicle_eq u v then [VStart p] else []
    | AEnd u | AStop u => if vehicle_eq u v then [VEnd] else []
    | APost _ | AConsume _ | AFinish => []
    end.

  Definition of_vehicles (e : abstract_event) : bool :=
    match e with APost _ | AConsume _ | AFinish => false | _ => true end.

  Ltac who v u :=
    let N := fresh in
    destruct (vehicle_eq v u) as [<-|N];
      [destruct (vehicle_eq v v); [|congruence] | destruct (vehicle_eq u v); [congruence|]].

  (** Events of vehicles happen if those of each vehicle do. *)
  Lemma vehicles_happen es : forall s (f : vehicle -> vehicle_state),
    forallb of_vehicles es = true -> over s = false -> allocation_within_bound s ->
    (forall v, vrun (flat_map (of_vehicle v) es) (state_of s v) = Some (f v)) ->
    exists s', happen es s s' /\ bag s' = bag s /\ over s' = false /\ allocation_within_bound s' /\
      forall v, state_of s' v = f v.
  Proof.
    induction es as [|e es IH]; intros s f Hes Ho Hw Hv; cbn [flat_map forallb] in *.
    - exists s. split; [constructor; apply same_refl|]. repeat (split; [assumption || reflexivity|]).
      intros v. specialize (Hv v). cbn in Hv. congruence.
    - apply andb_true_iff in Hes. destruct Hes as [He Hes].
      assert (Step : exists s1, happens e s s1 /\ bag s1 = bag s /\ over s1 = false /\
        forall v, vrun (of_vehicle v e) (state_of s v) = Some (state_of s1 v)).
      { assert (G : forall v, exists x, vrun (of_vehicle v e) (state_of s v) = Some x).
        { intros v. specialize (Hv v). rewrite vrun_app in Hv.
          destruct (vrun (of_vehicle v e) (state_of s v)); [eauto | discriminate]. }
        clear Hv IH. unfold state_of in *.
        destruct e; try discriminate; cbn [of_vehicle] in *; specialize (G v);
          destruct (vehicle_eq v v) as [_|]; try congruence; destruct G as [x G]; cbn [vrun] in G;
          destruct (tasks s v) as [q|] eqn:T; cbn [st] in G; try discriminate;
          try (destruct (holds s v) eqn:B; cbn in G; discriminate);
          try (destruct (holds s v) eqn:B; cbn in G; try discriminate);
          try (exfalso; assert (holds s v = true) by (apply Hw; congruence); congruence).
        - exists {| tasks := tasks s; holds := fun u => if vehicle_eq u v then true else holds s u; bag := bag s;
                    over := false |}. split; [|split; [reflexivity | split; [reflexivity|]]].
          + split; [exact Ho|]. unfold is_now, same_tasks, same_bag. cbn. auto.
          + intros u. cbn. who v u; cbn; [|reflexivity].
            rewrite T, B. reflexivity.
        - exists {| tasks := tasks s; holds := fun u => if vehicle_eq u v then false else holds s u; bag := bag s;
                    over := false |}. split; [|split; [reflexivity | split; [reflexivity|]]].
          + split; [exact Ho|]. unfold is_now, same_tasks, same_bag, idle. cbn. auto.
          + intros u. cbn. who v u; cbn; [|reflexivity].
            rewrite T, B. reflexivity.
        - exists {| tasks := fun u => if vehicle_eq u v then Some p else tasks s u; holds := holds s; bag := bag s;
                    over := false |}. split; [|split; [reflexivity | split; [reflexivity|]]].
          + split; [exact Ho|]. unfold is_now, same_held, same_bag, idle. cbn. auto.
          + intros u. cbn. who v u; cbn; [|reflexivity].
            rewrite T, B. reflexivity.
        - exists {| tasks := fun u => if vehicle_eq u v then None else tasks s u; holds := holds s; bag := bag s;
                    over := false |}. split; [|split; [reflexivity | split; [reflexivity|]]].
          + split; [exact Ho|]. unfold is_now, same_held, same_bag. cbn. rewrite T. repeat split; auto. discriminate.
          + intros u. cbn. who v u; cbn; [|reflexivity].
            rewrite T, B. reflexivity.
        - exists {| tasks := fun u => if vehicle_eq u v then None else tasks s u; holds := holds s; bag := bag s;
                    over := false |}. split; [|split; [reflexivity | split; [reflexivity|]]].
          + split; [exact Ho|]. unfold is_now, same_held, same_bag. cbn. rewrite T. repeat split; auto. discriminate.
          + intros u. cbn. who v u; cbn; [|reflexivity].
            rewrite T, B. reflexivity. }
      destruct Step as (s1 & Hs1 & Hb1 & Ho1 & Hst).
      assert (Hw1 : allocation_within_bound s1).
      { assert (I : abstract_inv s1); [|apply I]. apply inv_is_kept with s; [|right; eauto].
        split; [exact Hw | intros H; congruence]. }
      destruct (IH s1 f Hes Ho1 Hw1) as (s' & Hr & Hb & Ho' & Hw' & Hf).
      { intros v. specialize (Hv v). rewrite vrun_app, (Hst v) in Hv. exact Hv. }
      exists s'. split; [econstructor; eassumption|]. split; [congruence | auto].
  Qed.

  (** A vehicle's state is what A and B have of it. *)
  Lemma state_same s s' :
    allocation_within_bound s -> allocation_within_bound s' -> (forall v, state_of s v = state_of s' v) ->
    (forall v, tasks s v = tasks s' v) /\ (forall v, holds s v = holds s' v).
  Proof.
    intros H H' Hs. split; intros v; specialize (Hs v); specialize (H v); specialize (H' v); unfold state_of in Hs;
      destruct (tasks s v), (tasks s' v); cbn in Hs; try congruence;
      try (destruct (holds s v); congruence); try (destruct (holds s' v); congruence);
      try (rewrite H, H' by congruence; reflexivity); destruct (holds s v), (holds s' v); congruence.
  Qed.
End Abstract.
