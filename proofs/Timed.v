(** Runs with time, and that time can be erased: a timed run without its delays and clocks is a run. *)
From Dolphin Require Export Invariants.

Section Timed.
  Context {L : Names} {C : Code}.

  (** Times, and what the page leaves to the fleet: bounds, and the memory of the environment. *)
  Variable time : Type.
  Variable zero : time.
  Variable plus : time -> time -> time.
  Variable le : time -> time -> Prop.
  Variable memory : Type.

  (** What is awaited: the end of a vehicle's task, a timer, an answer, a reply, an input. *)
  Variable wait : Type.
  Variable same_wait : wait -> wait -> bool.

  (** The waits that effects begin, those that a configuration has, and the wait that an event ends. *)
  Variable begins_wait : list effect -> wait -> bool.
  Variable awaits_wait : configuration -> memory -> wait -> bool.
  Variable of_wait : event -> wait -> Prop.
  Variables lo hi : event -> wait -> time.

  (** Transitions in the environment: of the untimed semantics, in a world that its memory allows; the memory may
      change. [urgent]: one that needs no event, and depends neither on sensors nor on late vehicles. *)
  Variable in_environment :
    option event -> configuration -> memory -> label -> configuration -> memory -> list effect -> Prop.
  Hypothesis environment_law : forall x c e l c' e' E,
    in_environment x c e l c' e' E -> exists w, cstep w x c l c' E.
  Variable urgent : configuration -> memory -> Prop.

  (** [clocks a] is the time since the wait [a] began; [None] if it is not awaited. *)
  Definition clocks : Type := wait -> option time.
  Definition timed : Type := (configuration * memory * clocks)%type.

  Definition no_clocks : clocks := fun _ => None.
  Definition stop_clock (a : wait) (v : clocks) : clocks := fun b => if same_wait b a then None else v b.

  (** [v[E]] *)
  Definition begin_clocks (E : list effect) (c : configuration) (e : memory) (v : clocks) : clocks :=
    fun b => if awaits_wait c e b then (if begins_wait E b then Some zero else v b) else None.
  Definition pass (d : time) (v : clocks) : clocks := fun b => option_map (fun t => plus t d) (v b).

  (** Time may be as late as [t] for the wait: some event of it may still come. *)
  Definition in_time (b : wait) (t : time) : Prop :=
    (forall y, ~ of_wait y b) \/ exists y, of_wait y b /\ le t (hi y b).

  Inductive tlabel := Taken (x : option event) (l : label) (E : list effect) | Passed (d : time).

  Inductive tstep : timed -> tlabel -> timed -> Prop :=
  | own_step : forall c e v l c' e' E,
      in_environment None c e l c' e' E ->
      tstep (c, e, v) (Taken None l E) (c', e', begin_clocks E c' e' v)
  | event_step : forall c e v x a t l c' e' E,
      in_environment (Some x) c e l c' e' E -> of_wait x a -> v a = Some t -> le (lo x a) t -> le t (hi x a) ->
      ~ urgent c e -> (forall b t, v b = Some t -> in_time b t) ->
      tstep (c, e, v) (Taken (Some x) l E) (c', e', begin_clocks E c' e' (stop_clock a v))
  | delay_step : forall c e v d,
      ~ urgent c e -> (forall b t, v b = Some t -> in_time b (plus t d)) ->
      tstep (c, e, v) (Passed d) (c, e, pass d v).

  Inductive trun : timed -> list tlabel -> timed -> Prop :=
  | trun_here : forall s, trun s [] s
  | trun_then : forall s l s1 ls s2, tstep s l s1 -> trun s1 ls s2 -> trun s (l :: ls) s2.

  Definition urun_label : Type := (option event * label * list effect)%type.

  (** Runs of the untimed semantics; the world may be another one at each step. *)
  Inductive urun : configuration -> list urun_label -> configuration -> Prop :=
  | urun_here : forall c, urun c [] c
  | urun_then : forall w c x l E c1 ls c2,
      cstep w x c l c1 E -> urun c1 ls c2 -> urun c ((x, l, E) :: ls) c2.

  Definition erase (ls : list tlabel) : list urun_label :=
    flat_map (fun l => match l with Taken x l E => [(x, l, E)] | Passed _ => [] end) ls.

  (** A timed run without its delays and clocks is a run. *)
  Theorem time_can_be_erased s ls s' : trun s ls s' -> urun (fst (fst s)) (erase ls) (fst (fst s')).
  Proof.
    induction 1 as [s | s l s1 ls s2 Hs _ IH]; [constructor|].
    destruct Hs as [c e v l c' e' E Hi | c e v x a t l c' e' E Hi _ _ _ _ _ _ | c e v d _ _]; cbn in *.
    - destruct (environment_law _ _ _ _ _ _ _ Hi) as (w & Hw). econstructor; eassumption.
    - destruct (environment_law _ _ _ _ _ _ _ Hi) as (w & Hw). econstructor; eassumption.
    - exact IH.
  Qed.

  Lemma urun_reachable M s N c ls c' : urun c ls c' -> reachable M s N c -> reachable M s N c'.
  Proof. induction 1 as [c | w c x l E c1 ls c2 Hs _ IH]; intros H; [exact H|]. apply IH. eapply By_step;
    eassumption. Qed.

  (** So what holds of each configuration that a program comes to holds of those of all timed runs. *)
  Theorem timed_runs_keep_invariants M s N (P : configuration -> Prop) e ls t :
    (forall c, reachable M s N c -> P c) -> trun (initial M s N, e, no_clocks) ls t -> P (fst (fst t)).
  Proof. intros HP H. apply HP. eapply urun_reachable; [apply (time_can_be_erased _ _ _ H) | constructor]. Qed.

  (** An urgent step is not waited for: no time passes, and no event is taken. *)
  Theorem urgent_is_first c e v l s' : tstep (c, e, v) l s' -> urgent c e -> exists a E, l = Taken None a E.
  Proof. intros H Hu. inversion H; subst; try contradiction. eauto. Qed.
End Timed.
