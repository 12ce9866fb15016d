(** Labelled transition systems: runs, termination, bisimulations, and what bisimilar states have in common. Nothing of
    Dolphin is in this file. *)
From Coq Require Export List Bool Arith Lia.
Export ListNotations.
Set Implicit Arguments.
Unset Strict Implicit.

Lemma Forall2_length X Y (P : X -> Y -> Prop) xs ys : Forall2 P xs ys -> length xs = length ys.
Proof. induction 1; cbn; congruence. Qed.

Section System.
  Variables state label : Type.
  Variable goes : state -> label -> state -> Prop.

  Inductive run : state -> list label -> state -> Prop :=
  | Here : forall s, run s [] s
  | Then : forall s l s1 ls t, goes s l s1 -> run s1 ls t -> run s (l :: ls) t.

  Lemma run_app s ls s1 : run s ls s1 -> forall ls' t, run s1 ls' t -> run s (ls ++ ls') t.
  Proof. induction 1; cbn; intros; [assumption | econstructor; eauto]. Qed.

  (** Nothing is possible: a deadlock, or an end. *)
  Definition at_rest (s : state) : Prop := forall l t, ~ goes s l t.

  Definition follows (t s : state) : Prop := exists l, goes s l t.

  (** All runs from [s] end. *)
  Definition terminates (s : state) : Prop := Acc follows s.

  (** Some run from [s] has no end. *)
  CoInductive endless : state -> Prop :=
  | Endless : forall s l t, goes s l t -> endless t -> endless s.

  Lemma terminates_not_endless s : terminates s -> endless s -> False.
  Proof.
    induction 1 as [s _ IH]. intros H. destruct H as [s l t Hg Ht]. eapply IH; [exists l; exact Hg | exact Ht].
  Qed.
End System.

Section Bisimulation.
  Variables state label state' label' : Type.
  Variable goes : state -> label -> state -> Prop.
  Variable goes' : state' -> label' -> state' -> Prop.
  (** Labels that count as the same: those that differ in texts for people only. *)
  Variable same : label -> label' -> Prop.

  Record bisimulation (R : state -> state' -> Prop) : Prop := {
    forth : forall s s' l t, R s s' -> goes s l t -> exists l' t', same l l' /\ goes' s' l' t' /\ R t t';
    back : forall s s' l' t', R s s' -> goes' s' l' t' -> exists l t, same l l' /\ goes s l t /\ R t t'
  }.
  Arguments forth {R} _ {s s' l t} _ _.
  Arguments back {R} _ {s s' l' t'} _ _.

  Variable R : state -> state' -> Prop.
  Hypothesis HR : bisimulation R.

  (** A run of the one is a run of the other, of the same length and with the same labels. *)
  Theorem bisimilar_runs s ls t :
    run goes s ls t -> forall s', R s s' ->
    exists ls' t', Forall2 same ls ls' /\ run goes' s' ls' t' /\ R t t'.
  Proof.
    induction 1 as [s | s l s1 ls t Hg _ IH]; intros s' Hs.
    - exists [], s'. split; [constructor | split; [constructor | exact Hs]].
    - destruct (forth HR Hs Hg) as (l' & s1' & Hl & Hg' & H1). destruct (IH _ H1) as (ls' & t' & Hls & Hr & Ht).
      exists (l' :: ls'), t'. split; [constructor; assumption | split; [econstructor; eassumption | exact Ht]].
  Qed.

  Theorem bisimilar_runs_back s' ls' t' :
    run goes' s' ls' t' -> forall s, R s s' ->
    exists ls t, Forall2 same ls ls' /\ run goes s ls t /\ R t t'.
  Proof.
    induction 1 as [s' | s' l' s1' ls' t' Hg _ IH]; intros s Hs.
    - exists [], s. split; [constructor | split; [constructor | exact Hs]].
    - destruct (back HR Hs Hg) as (l & s1 & Hl & Hg' & H1). destruct (IH s1 H1) as (ls & t & Hls & Hr & Ht).
      exists (l :: ls), t. split; [constructor; assumption | split; [econstructor; eassumption | exact Ht]].
  Qed.

  (** Both can do nothing, or none of them. *)
  Theorem bisimilar_rest s s' : R s s' -> (at_rest goes s <-> at_rest goes' s').
  Proof.
    intros Hs. split; intros H l t Hg.
    - destruct (back HR Hs Hg) as (l' & t' & _ & Hg' & _). exact (H _ _ Hg').
    - destruct (forth HR Hs Hg) as (l' & t' & _ & Hg' & _). exact (H _ _ Hg').
  Qed.

  (** Both terminate, or none of them. *)
  Theorem bisimilar_termination s s' : R s s' -> (terminates goes s <-> terminates goes' s').
  Proof.
    intros Hs. split; intros H; [revert s' Hs | revert s Hs]; induction H as [x _ IH]; intros y Hy; constructor;
      intros z (l & Hg).
    - destruct (back HR Hy Hg) as (l' & z' & _ & Hg' & Hz). eapply IH; [exists l'; exact Hg' | exact Hz].
    - destruct (forth HR Hy Hg) as (l' & z' & _ & Hg' & Hz). eapply IH; [exists l'; exact Hg' | exact Hz].
  Qed.

  Lemma bisimilar_endless : forall s s', R s s' -> endless goes s -> endless goes' s'.
  Proof.
    cofix go. intros s s' Hs H. destruct H as [s l t Hg Ht].
    destruct (forth HR Hs Hg) as (l' & t' & _ & Hg' & Htt). econstructor; [exact Hg' | exact (go _ _ Htt Ht)].
  Qed.
End Bisimulation.

Arguments forth {state label state' label' goes goes' same R} _ {s s' l t} _ _.
Arguments back {state label state' label' goes goes' same R} _ {s s' l' t'} _ _.
