(** The reductions of docs/explorer.md, on labelled transition systems. What the code relies on is a hypothesis here, in
    the words of that page. *)
From Dolphin Require Export Systems.
Set Implicit Arguments.
Unset Strict Implicit.

(** {1 Representatives}

    States that are equal but for what no step depends on, such as names or dead variables: [equal] is a bisimulation.
    The search replaces each state that it reaches by an equal one. *)
Section Representatives.
  Variables state label : Type.
  Variable goes : state -> label -> state -> Prop.
  Variable same : label -> label -> Prop.
  Hypothesis same_trans : forall l l' l'', same l l' -> same l' l'' -> same l l''.
  Variable equal : state -> state -> Prop.
  Hypothesis equal_trans : forall s t u, equal s t -> equal t u -> equal s u.
  Hypothesis equal_bisimulation : bisimulation goes goes same equal.

  (** What is visited: of each step a representative is followed, and of the state that it leads to, an equal one is
      visited. It need not be the same one each time. *)
  Variable visits : state -> label -> state -> Prop.
  Hypothesis visits_sound : forall s l u, visits s l u -> exists t, goes s l t /\ equal t u.
  Hypothesis visits_complete :
    forall s l t, goes s l t -> exists l' u, same l l' /\ visits s l' u /\ equal t u.

  (** The visited system is bisimilar to the whole one. So by the theorems of [Systems] it has the same verdicts. *)
  Theorem representatives_bisimilar : bisimulation goes visits same equal.
  Proof.
    split.
    - intros s s' l t Hs Hg. destruct (forth equal_bisimulation Hs Hg) as (l1 & t1 & H1 & G1 & E1).
      destruct (visits_complete G1) as (l2 & u & H2 & V & E2).
      exists l2, u. split; [eapply same_trans; eassumption | split; [exact V | eapply equal_trans; eassumption]].
    - intros s s' l u Hs V. destruct (visits_sound V) as (t' & G & E).
      destruct (back equal_bisimulation Hs G) as (l0 & t & H0 & G0 & E0).
      exists l0, t. split; [exact H0 | split; [exact G0 | eapply equal_trans; eassumption]].
  Qed.

  (** A violation is found, in as many steps, if it is one in all equal states; and one that is found is one. *)
  Theorem representatives_keep_violations (violates : state -> Prop) :
    (forall s s', equal s s' -> (violates s <-> violates s')) -> forall s s', equal s s' -> forall n,
    (exists ls t, length ls = n /\ run goes s ls t /\ violates t) <->
    (exists ls t, length ls = n /\ run visits s' ls t /\ violates t).
  Proof.
    intros HV s s' Hs n. split; intros (ls & t & Hn & Hr & Ht).
    - destruct (bisimilar_runs representatives_bisimilar Hr Hs) as (ls' & t' & Hls & Hr' & Htt).
      exists ls', t'. split; [rewrite <- Hn; symmetry; eapply Forall2_length; exact Hls | split; [exact Hr'|]].
      apply (HV t t' Htt). exact Ht.
    - destruct (bisimilar_runs_back representatives_bisimilar Hr Hs) as (ls' & t' & Hls & Hr' & Htt).
      exists ls', t'. split; [rewrite <- Hn; eapply Forall2_length; exact Hls | split; [exact Hr'|]].
      apply (HV t' t Htt). exact Ht.
  Qed.
End Representatives.

(** {1 Symmetry} *)
Section Symmetry.
  Variables state label : Type.
  Variable goes : state -> label -> state -> Prop.
  Variable same : label -> label -> Prop.
  Hypothesis same_sym : forall l l', same l l' -> same l' l.
  Hypothesis same_trans : forall l l' l'', same l l' -> same l' l'' -> same l l''.

  (** A group that acts on the states by automorphisms. *)
  Variable group : Type.
  Variable unit : group.
  Variable times : group -> group -> group.
  Variable inverse : group -> group.
  Variable act : group -> state -> state.
  Hypothesis act_unit : forall s, act unit s = s.
  Hypothesis act_times : forall g h s, act (times g h) s = act g (act h s).
  Hypothesis act_inverse : forall g s, act (inverse g) (act g s) = s.
  Hypothesis automorphism :
    forall g s l t, goes s l t -> exists l', same l l' /\ goes (act g s) l' (act g t).

  Definition orbit (s t : state) : Prop := exists g, t = act g s.

  Lemma orbit_refl s : orbit s s.
  Proof. exists unit. symmetry. apply act_unit. Qed.
  Lemma orbit_sym s t : orbit s t -> orbit t s.
  Proof. intros (g & ->). exists (inverse g). symmetry. apply act_inverse. Qed.
  Lemma orbit_trans s t u : orbit s t -> orbit t u -> orbit s u.
  Proof. intros (g & ->) (h & ->). exists (times h g). symmetry. apply act_times. Qed.

  (** c and g(c) are bisimilar. *)
  Theorem orbits_bisimilar : bisimulation goes goes same orbit.
  Proof.
    split.
    - intros s s' l t (g & ->) Hg. destruct (automorphism g Hg) as (l' & Hl & Hg').
      exists l', (act g t). split; [exact Hl | split; [exact Hg' | exists g; reflexivity]].
    - intros s s' l t (g & ->) Hg. destruct (automorphism (inverse g) Hg) as (l' & Hl & Hg').
      rewrite act_inverse in Hg'.
      exists l', (act (inverse g) t). split; [apply same_sym; exact Hl | split; [exact Hg'|]].
      apply orbit_sym. exists (inverse g). reflexivity.
  Qed.

  Variable visits : state -> label -> state -> Prop.
  Hypothesis visits_sound : forall s l u, visits s l u -> exists t, goes s l t /\ orbit t u.
  Hypothesis visits_complete :
    forall s l t, goes s l t -> exists l' u, same l l' /\ visits s l' u /\ orbit t u.

  (** Some state of the orbit of each state that is reached: the quotient is bisimilar to the system. *)
  Theorem quotient_bisimilar : bisimulation goes visits same orbit.
  Proof.
    apply representatives_bisimilar; [exact same_trans | exact orbit_trans | exact orbits_bisimilar
      | exact visits_sound | exact visits_complete].
  Qed.

  Lemma run_act g s ls t : run goes s ls t -> exists ls', run goes (act g s) ls' (act g t).
  Proof.
    induction 1 as [s | s l s1 ls t Hg _ (ls' & IH)].
    - exists []. constructor.
    - destruct (automorphism g Hg) as (l' & _ & Hg'). exists (l' :: ls'). econstructor; eassumption.
  Qed.

  (** If the group maps the first state to itself, no state is visited that the system does not have. *)
  Theorem quotient_not_larger s : (forall g, act g s = s) ->
    forall ls t, run visits s ls t -> exists ls', run goes s ls' t.
  Proof.
    intros Fixed ls t H. destruct (bisimilar_runs_back quotient_bisimilar H (orbit_refl s)) as (ls' & t0 & _ & Hr & Ht).
    destruct Ht as (g & ->).
    rewrite <- (Fixed g). eapply run_act. exact Hr.
  Qed.
End Symmetry.

(** {1 Dead variables}

    A state is a place of the program and the values of variables; keys of N are variables too, with the list of their
    pairs as the value. At a place the variables that are not live are forgotten. *)
Section Dead_variables.
  Variables place variable value label : Type.
  Definition valued : Type := (place * (variable -> value))%type.
  Variable goes : valued -> label -> valued -> Prop.

  Variable reads : place -> variable -> Prop.
  Variable writes : place -> label -> place -> variable -> bool.

  (** A step depends on what it reads alone: from other values of the rest the same step is possible,
    it writes the same,
      and leaves the rest as it is. *)
  Hypothesis steps_by_reads :
    forall c v v' l d u, (forall x, reads c x -> v x = v' x) -> goes (c, v) l (d, u) ->
    exists u', goes (c, v') l (d, u') /\
      forall x, if writes c l d x then u x = u' x else u x = v x /\ u' x = v' x.

  (** A variable is live where a step reads it,
    and before a step that does not write it if it is live after the step. *)
  Variable live : place -> variable -> bool.
  Hypothesis live_if_read : forall c x, reads c x -> live c x = true.
  Hypothesis live_before : forall c l d x, live d x = true -> writes c l d x = false -> live c x = true.

  Definition alike (s t : valued) : Prop :=
    fst s = fst t /\ forall x, live (fst s) x = true -> snd s x = snd t x.

  Variable nothing : value.
  Definition forget (s : valued) : valued := (fst s, fun x => if live (fst s) x then snd s x else nothing).

  Lemma alike_sym s t : alike s t -> alike t s.
  Proof. intros (H & E). split; [auto|]. rewrite <- H. intros x Hx. symmetry. auto. Qed.
  Lemma alike_trans s t u : alike s t -> alike t u -> alike s u.
  Proof.
    intros (H & E) (H' & E'). split; [congruence|]. intros x Hx. rewrite E by exact Hx. apply E'. rewrite <- H.
      exact Hx.
  Qed.
  Lemma forget_alike s : alike s (forget s).
  Proof. split; [reflexivity|]. cbn. intros x ->. reflexivity. Qed.

  Lemma alike_step s s' l t : alike s s' -> goes s l t -> exists t', goes s' l t' /\ alike t t'.
  Proof.
    destruct s as [c v], s' as [c' v'], t as [d u]. intros (Hc & E) Hg. cbn in Hc, E. subst c'.
    destruct (@steps_by_reads c v v' l d u) as (u' & Hg' & Hu); [|exact Hg|].
    { intros x Hx. apply E, live_if_read, Hx. }
    exists (d, u'). split; [exact Hg'|]. split; [reflexivity|]. cbn. intros x Hx. specialize (Hu x).
    destruct (writes c l d x) eqn:W; [exact Hu|]. destruct Hu as (-> & ->). apply E. eapply live_before; eassumption.
  Qed.

  (** States that differ in dead variables only are bisimilar. *)
  Theorem dead_variables_bisimilar : bisimulation goes goes eq alike.
  Proof.
    split.
    - intros s s' l t Hs Hg. destruct (alike_step Hs Hg) as (t' & Hg' & Ht). exists l, t'. auto.
    - intros s s' l t Hs Hg. destruct (alike_step (alike_sym Hs) Hg) as (t' & Hg' & Ht). exists l, t'.
      auto using alike_sym.
  Qed.

  Inductive forgets (s : valued) (l : label) : valued -> Prop :=
  | Forgets : forall t, goes s l t -> forgets s l (forget t).

  (** A search that forgets them at each step visits a bisimilar system. *)
  Theorem forgetting_bisimilar : bisimulation goes forgets eq alike.
  Proof.
    apply (@representatives_bisimilar _ _ goes eq) with (equal := alike).
    - intros l l' l'' -> H. exact H.
    - exact alike_trans.
    - exact dead_variables_bisimilar.
    - intros s l u [t Hg]. exists t. split; [exact Hg | apply forget_alike].
    - intros s l t Hg. exists l, (forget t). split; [reflexivity | split; [constructor; exact Hg | apply forget_alike]].
  Qed.
End Dead_variables.
