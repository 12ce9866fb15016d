(** To execute bisimilar residuals is bisimilar: the whole program has the same runs. *)
From Dolphin Require Systems.
From Dolphin Require Export Bisimilarity.
Set Implicit Arguments.
Unset Strict Implicit.

Section Executing.
  Context {L : Names} {C : Code}.

  (** Configurations as a labelled transition system: the label has the world and the event too. *)
  Definition moves (c : configuration) (a : world * option event * label) (c' : configuration) : Prop :=
    let '(w, x, l) := a in exists E, cstep w x c l c' E.

  Definition same_but_residual (c c' : configuration) : Prop :=
    c = c' \/ exists M r r' S, c = executes M r S /\ c' = executes M r' S /\ bisimilar r r'.

  (** ON-INTERRUPT puts the recruited vehicles into B in the order of the residual, so [onInterrupt] is left out. *)
  Hypothesis no_on_interrupt : on_interrupt = None.

  Lemma home_none k S : home k S = None.
  Proof. unfold home. rewrite no_on_interrupt. reflexivity. Qed.

  Lemma same_but_residual_sym c c' : same_but_residual c c' -> same_but_residual c' c.
  Proof.
    intros [-> | (M & r & r' & S & -> & -> & H)]; [left; reflexivity | right].
    exists M, r', r, S. auto using bisimilar_sym.
  Qed.

  Lemma executing_step c c' a d : same_but_residual c c' -> moves c a d -> exists d', moves c' a d' /\
    same_but_residual d d'.
  Proof.
    destruct a as [[w x] l]. intros [-> | (M & r & r' & S & -> & -> & Hr)] (E & Hs).
    - exists d. split; [exists E; exact Hs | left; reflexivity].
    - assert (Part : forall o S1 E1, step x (alone w) S r l S1 o E1 -> exists o' E',
        step x (alone w) S r' l S1 o' E' /\ match o, o' with
          | Next q, Next q' => bisimilar q q' | Ok, Ok => True | Err m, Err m' => m = m' | Ends y, Ends y' => y = y'
          | _, _ => False end).
      { intros o S1 E1 H. apply step_goes in H. destruct (bisimilar_steps Hr H) as ([l' S2 o' E'] & H' & <- & <- & Ho).
        exists o', E'. split; [apply (goes_step _ _ _ _ _ H') | exact Ho]. }
      inversion Hs; subst.
      + (* INPUT *) eexists. split.
        * eexists. apply INPUT; [assumption | intros y; discriminate].
        * right. exists M, r, r', (with_space (post [(key, x0)] (space S)) S). auto.
      + match goal with H : step _ _ _ _ _ _ _ _ |- _ => destruct (Part _ _ _ H) as (o' & E' & H' & Ho) end.
        destruct o'; try contradiction. eexists. split; [eexists; eapply EXECUTE_DONE; exact H' | left; reflexivity].
      + match goal with H : step _ _ _ _ _ _ _ _ |- _ => destruct (Part _ _ _ H) as (o' & E' & H' & Ho) end.
        destruct o'; try contradiction. subst. eexists. split; [eexists; eapply EXECUTE_ERR; exact H' | left;
          reflexivity].
      + match goal with H : step _ _ _ _ _ _ _ _ |- _ => destruct (Part _ _ _ H) as (o' & E' & H' & Ho) end.
        destruct o'; try contradiction. eexists. split; [eexists; eapply EXECUTING; exact H'|].
        right. do 4 eexists. split; [reflexivity | split; [reflexivity | exact Ho]].
      + match goal with H : step _ _ _ _ _ _ _ _ |- _ => destruct (Part _ _ _ H) as (o' & E' & H' & Ho) end.
        destruct o'; try contradiction. subst. eexists. split; [eexists; eapply ENDS_all; exact H' | left; reflexivity].
      + (* INTERRUPT *) exists (ended (does (ensured r') S) Interrupted). split.
        * eexists. apply INTERRUPT; [intros y; discriminate | apply home_none].
        * left. cbn [residual_of]. rewrite (face_ends (bisimilar_face Hr)). reflexivity.
      + rewrite home_none in *. discriminate.
  Qed.

  (** Executing one is strongly bisimilar to executing the other, from every store, A, B and N. *)
  Theorem executing_bisimilar : Systems.bisimulation moves moves eq same_but_residual.
  Proof.
    split.
    - intros c c' a d Hc H. destruct (executing_step Hc H) as (d' & H' & Hd). exists a, d'. auto.
    - intros c c' a d Hc H. destruct (executing_step (same_but_residual_sym Hc) H) as (d' & H' & Hd).
      exists a, d'. auto using same_but_residual_sym.
  Qed.
End Executing.
