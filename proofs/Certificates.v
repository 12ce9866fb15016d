(** Certificates of [dolphin explore --certify]: the states of a program in a row, checked one after the other. *)
From Coq Require Import FMapPositive NArith.
From Dolphin Require Import Systems.
Set Implicit Arguments.
Unset Strict Implicit.

(** {1 Of any system} *)

Fixpoint iterate (A : Type) (f : A -> option A) (n : nat) (a : A) : option A :=
  match n with
  | 0 => Some a
  | S n => match f a with Some a => iterate f n a | None => None end
  end.

Section Certificates.
  Variables state move : Type.
  Variable successors : state -> list (move * state).
  (** What must hold of each state and its transitions. *)
  Variable fine : state -> list (move * state) -> bool.
  Variable same : state -> state -> bool.
  Variable first : state.

  (** The certificate: how many states there are, the places of the successors of the state at a place, and if every
      run ends, a bound on the rest of the runs from there. None of it is trusted. *)
  Variable last : positive.
  Variable places : positive -> list (move * state) -> list positive.
  Variable ranked : bool.
  Variable rank : positive -> N.

  Definition leads (s : state) (m : move) (t : state) : Prop := In (m, t) (successors s).
  Definition reached (s : state) : Prop := exists ms, run leads first ms s.

  (** Equality is asked of states of the program only. *)
  Hypothesis same_law : forall s t, reached s -> reached t -> same s t = true -> s = t.

  Definition known := PositiveMap.t state.

  (** [s] stands at [p], from now on or already. *)
  Definition place (K : known) (p : positive) (s : state) : option known :=
    match PositiveMap.find p K with
    | None => Some (PositiveMap.add p s K)
    | Some t => if same s t then Some K else None
    end.

  Definition lower (p from : positive) : bool := if ranked then N.ltb (rank p) (rank from) else true.

  Fixpoint place_all (from : positive) (ms : list (move * state)) (ps : list positive) (K : known) : option known :=
    match ms, ps with
    | [], [] => Some K
    | (_, s) :: ms, p :: ps =>
        if Pos.leb p last && lower p from then
          match place K p s with Some K => place_all from ms ps K | None => None end
        else None
    | _, _ => None
    end.

  Definition visit (i : positive) (K : known) : option known :=
    match PositiveMap.find i K with
    | None => None
    | Some s => let ms := successors s in if fine s ms then place_all i ms (places i ms) K else None
    end.

  Definition visit_next (y : positive * known) : option (positive * known) :=
    match visit (fst y) (snd y) with Some K => Some (Pos.succ (fst y), K) | None => None end.

  (** The next [n] states from [i] on: the place after them, unless one is wrong. *)
  Definition visits (n : nat) (i : positive) (K : known) : option (positive * known) := iterate visit_next n (i, K).

  Definition accepts (n : nat) : bool :=
    match visits n 1 (PositiveMap.add 1%positive first (PositiveMap.empty state)) with
    | Some (i, _) => Pos.eqb i (Pos.succ last)
    | None => false
    end.

  Definition at_place (K : known) p s := PositiveMap.find p K = Some s.
  Definition more (K K' : known) := forall p s, at_place K p s -> at_place K' p s.
  Definition all_reached (K : known) := forall p s, at_place K p s -> reached s.

  Lemma more_refl K : more K K.
  Proof. intros p s H. exact H. Qed.

  Lemma more_trans K K' K'' : more K K' -> more K' K'' -> more K K''.
  Proof. intros H H' p s Hp. apply H', H, Hp. Qed.

  Lemma place_law K p s K' :
    reached s -> all_reached K -> place K p s = Some K' -> more K K' /\ all_reached K' /\ at_place K' p s.
  Proof.
    unfold place, at_place. intros Hs HK H. destruct (PositiveMap.find p K) as [t|] eqn:Hp.
    - destruct (same s t) eqn:Ht; inversion H; subst K'.
      rewrite (same_law Hs (HK _ _ Hp) Ht). split; [apply more_refl | split; assumption].
    - inversion H; subst K'. split; [| split; [| apply PositiveMap.gss]].
      + intros q t Hq. unfold at_place in *. rewrite PositiveMap.gso; [exact Hq |]. intros ->. congruence.
      + intros q t Hq. unfold at_place in Hq. destruct (Pos.eq_dec q p) as [->|Hne].
        * rewrite PositiveMap.gss in Hq. inversion Hq; subst; exact Hs.
        * rewrite PositiveMap.gso in Hq by exact Hne. exact (HK _ _ Hq).
  Qed.

  (** The successor by each transition stands at a place, with a lower rank. *)
  Definition covered (K : known) (from : positive) (ms : list (move * state)) :=
    forall m s, In (m, s) ms -> exists p, (p <= last)%positive /\ lower p from = true /\ at_place K p s.

  Lemma place_all_law from ms : forall ps K K',
    (forall m s, In (m, s) ms -> reached s) -> all_reached K -> place_all from ms ps K = Some K' ->
    more K K' /\ all_reached K' /\ covered K' from ms.
  Proof.
    induction ms as [|[m s] ms IH]; intros [|p ps] K K' Hms HK H; cbn in H; try discriminate.
    - inversion H; subst. split; [apply more_refl | split; [exact HK | intros ? ? []]].
    - destruct (Pos.leb p last && lower p from) eqn:Hb; [|discriminate].
      apply andb_prop in Hb. destruct Hb as [Hle Hlow]. apply Pos.leb_le in Hle.
      destruct (place K p s) as [K1|] eqn:H1; [|discriminate].
      destruct (@place_law K p s K1 (Hms m s (or_introl eq_refl)) HK H1) as (M1 & HK1 & Hp).
      destruct (IH ps K1 K' (fun m' t Ht => Hms m' t (or_intror Ht)) HK1 H) as (M2 & HK2 & Hc).
      split; [exact (more_trans M1 M2) | split; [exact HK2 |]].
      intros m' t [Ht|Ht]; [| exact (Hc m' t Ht)].
      inversion Ht; subst. exists p. split; [exact Hle | split; [exact Hlow | exact (M2 _ _ Hp)]].
  Qed.

  Lemma reached_next s m t : reached s -> leads s m t -> reached t.
  Proof.
    intros [ms Hr] Hg. exists (ms ++ [m]). apply (run_app Hr). econstructor; [exact Hg | constructor].
  Qed.

  (** [K] has the successors of all that stands at [i]. *)
  Definition closed_at (K : known) (i : positive) :=
    exists s, at_place K i s /\ fine s (successors s) = true /\ covered K i (successors s).

  Lemma visit_law i K K' : all_reached K -> visit i K = Some K' -> more K K' /\ all_reached K' /\ closed_at K' i.
  Proof.
    unfold visit. intros HK H. destruct (PositiveMap.find i K) as [s|] eqn:Hi; [|discriminate].
    cbv zeta in H. destruct (fine s (successors s)) eqn:Hf; [|discriminate].
    destruct (@place_all_law i (successors s) _ K K' (fun m t Ht => @reached_next s m t (HK _ _ Hi) Ht) HK H)
      as (M & HK' & Hc).
    split; [exact M | split; [exact HK' |]]. exists s. split; [exact (M _ _ Hi) | split; assumption].
  Qed.

  Lemma closed_more K K' i : more K K' -> closed_at K i -> closed_at K' i.
  Proof.
    intros M (s & Hs & Hf & Hc). exists s. split; [exact (M _ _ Hs) | split; [exact Hf |]].
    intros m t Ht. destruct (Hc m t Ht) as (p & Hle & Hlow & Hp). exists p. eauto.
  Qed.

  Lemma visits_law n : forall i K j K',
    all_reached K -> visits n i K = Some (j, K') ->
    more K K' /\ all_reached K' /\ forall p, (i <= p)%positive -> (p < j)%positive -> closed_at K' p.
  Proof.
    unfold visits. induction n as [|n IH]; intros i K j K' HK H; cbn in H.
    - inversion H; subst. split; [apply more_refl | split; [exact HK |]]. intros p Hi Hj. lia.
    - unfold visit_next in H at 1. cbn [fst snd] in H. destruct (visit i K) as [K1|] eqn:H1; [|discriminate].
      destruct (visit_law HK H1) as (M1 & HK1 & Hc1). destruct (IH _ _ _ _ HK1 H) as (M2 & HK2 & Hc2).
      split; [exact (more_trans M1 M2) | split; [exact HK2 |]]. intros p Hi Hj.
      destruct (Pos.eq_dec i p) as [<-|Hne]; [exact (closed_more M2 Hc1) | apply Hc2; lia].
  Qed.

  Definition begins : reached first := ex_intro _ [] (Here leads first).

  Lemma accepted n :
    accepts n = true ->
    exists K, all_reached K /\ at_place K 1%positive first /\ forall p, (p <= last)%positive -> closed_at K p.
  Proof.
    unfold accepts. set (K0 := PositiveMap.add 1%positive first (PositiveMap.empty state)). intros H.
    destruct (visits n 1 K0) as [[j K]|] eqn:Hv; [|discriminate]. apply Pos.eqb_eq in H. subst j.
    assert (H0 : all_reached K0).
    { intros p s Hp. unfold at_place, K0 in Hp. destruct (Pos.eq_dec p 1) as [->|Hne].
      - rewrite PositiveMap.gss in Hp. inversion Hp; subst. exact begins.
      - rewrite PositiveMap.gso in Hp by exact Hne. rewrite PositiveMap.gempty in Hp. discriminate. }
    destruct (visits_law H0 Hv) as (M & HK & Hc). exists K. split; [exact HK | split].
    - apply M. unfold at_place, K0. apply PositiveMap.gss.
    - intros p Hp. apply Hc; lia.
  Qed.

  Lemma run_covered K (HK : forall p, (p <= last)%positive -> closed_at K p) s ms t :
    run leads s ms t -> forall p, (p <= last)%positive -> at_place K p s ->
    fine t (successors t) = true /\ (ranked = true -> length ms <= N.to_nat (rank p)).
  Proof.
    induction 1 as [s | s m s1 ms t Hg _ IH]; intros p Hp Hs;
      destruct (HK p Hp) as (s' & Hs' & Hf & Hc); assert (s' = s) by (unfold at_place in *; congruence); subst s'.
    - split; [exact Hf | cbn; lia].
    - destruct (Hc m s1 Hg) as (q & Hq & Hlow & Hs1). destruct (IH q Hq Hs1) as [Hft Hlen].
      split; [exact Hft |]. intros Hr. cbn. specialize (Hlen Hr). unfold lower in Hlow. rewrite Hr in Hlow.
      apply N.ltb_lt in Hlow. lia.
  Qed.

  (** What is asked holds of each state of each run. *)
  Theorem certified n : accepts n = true -> forall ms s, run leads first ms s -> fine s (successors s) = true.
  Proof.
    intros H ms s Hr. destruct (accepted H) as (K & _ & H1 & HK).
    exact (proj1 (run_covered HK Hr (p := 1%positive) (Pos.le_1_l last) H1)).
  Qed.

  (** With ranks no run is longer than that of the first state. *)
  Theorem certified_to_end n :
    ranked = true -> accepts n = true -> forall ms s, run leads first ms s -> length ms <= N.to_nat (rank 1%positive).
  Proof.
    intros Hranked H ms s Hr. destruct (accepted H) as (K & _ & H1 & HK).
    exact (proj2 (run_covered HK Hr (p := 1%positive) (Pos.le_1_l last) H1) Hranked).
  Qed.
End Certificates.

(** {1 Of programs} *)

From Dolphin Require Import Derivations.

Section Programs.
  Context {L : Names}.
  (** Code, whose messages may depend on the place of the script. *)
  Variable code_at : configuration -> Code.
  (** What the outside remembers, and the situations that it may bring about: a world, perhaps an event, and what is
      remembered then. *)
  Variable memory : Type.
  Variable situations : configuration -> memory -> list (world * option event * memory).

  Definition program_state : Type := configuration * memory.
  Definition program_move : Type := ctransition * list String.string.

  Definition outcomes (c : configuration) (y : world * option event * memory) : list (program_move * program_state) :=
    match y with
    | (w, e, m) => map (fun d => (d, (match fst d with To _ c' _ => c' end, m))) (cderivations (C := code_at c) w e c)
    end.

  Definition program_successors (s : program_state) : list (program_move * program_state) :=
    flat_map (outcomes (fst s)) (situations (fst s) (snd s)).

  Definition program_accepts := accepts program_successors.

  (** The states that a program comes to by the rules, in so many transitions. *)
  Inductive comes_to (s : program_state) : nat -> program_state -> Prop :=
  | At_first : comes_to s 0 s
  | By_rule : forall n c m w e m' l c' E,
      comes_to s n (c, m) -> In (w, e, m') (situations c m) -> cstep (C := code_at c) w e c l c' E ->
      comes_to s (S n) (c', m').

  Lemma outcomes_by_rules c w e m l c' E :
    cstep (C := code_at c) w e c l c' E -> exists d, In (d, (c', m)) (outcomes c (w, e, m)).
  Proof.
    intros H. apply configurations_agree in H. rewrite <- cderivations_are_csteps in H. apply in_map_iff in H.
    destruct H as (d & Hd & Hin). exists d. cbn. apply in_map_iff. exists d. rewrite Hd. split; [reflexivity | exact Hin].
  Qed.

  Lemma comes_by_run s n t : comes_to s n t -> exists ds, Systems.run (leads program_successors) s ds t /\ length ds = n.
  Proof.
    induction 1 as [| n c m w e m' l c' E _ (ds & IH & Hn) Hin Hstep]; [exists []; split; [constructor | reflexivity] |].
    destruct (outcomes_by_rules m' Hstep) as (d & Hd). exists (ds ++ [d]). split.
    - apply (run_app IH). econstructor; [| constructor]. unfold leads, program_successors. cbn [fst snd].
      apply in_flat_map. exists (w, e, m'). split; assumption.
    - rewrite app_length. cbn. lia.
  Qed.

  Section Accepted.
    Variable fine : program_state -> list (program_move * program_state) -> bool.
    Variable same : program_state -> program_state -> bool.
    Variable first : program_state.
    Variable last : positive.
    Variable places : positive -> list (program_move * program_state) -> list positive.
    Variable ranked : bool.
    Variable rank : positive -> N.
    Variable n : nat.
    Hypothesis same_law : forall s t,
      reached program_successors first s -> reached program_successors first t -> same s t = true -> s = t.
    Hypothesis is_accepted : program_accepts fine same first last places ranked rank n = true.

    (** A certificate that is accepted speaks of all that the rules allow. *)
    Theorem certified_program i s : comes_to first i s -> fine s (program_successors s) = true.
    Proof. intros Hs. destruct (comes_by_run Hs) as (ds & Hr & _). exact (certified same_law is_accepted Hr). Qed.

    (** With ranks, no run has more transitions than the rank of the first state. *)
    Theorem certified_program_ends i s : ranked = true -> comes_to first i s -> i <= N.to_nat (rank 1%positive).
    Proof.
      intros Hranked Hs. destruct (comes_by_run Hs) as (ds & Hr & <-).
      exact (certified_to_end same_law Hranked is_accepted Hr).
    Qed.
  End Accepted.
End Programs.
