(** The syntax of the core: tasks. *)
From Dolphin Require Export Metavariables.

Section Syntax.
  Context {L : Names}.

  (** How [until] and [assure], [during] and [within] end what they cut off: as done, or as failed. *)
  Inductive on_cut := Completes | Fails (at_site : site).

  Inductive duration := Seconds (n : seconds) | Given_by (d : code).

  (** What the end of a task does: [Gives_back] until its branch is chosen. *)
  Inductive end_deed := Posts (k : key) (x : value) | Assigns (x : assignment) | Gives_back.

  Inductive task :=
  | TPlan (p : plan)
  | TAction (a : code)
  | TCondition (g : code)
  | TSequence (t t' : task)                                (* t >> t' *)
  | TParallel (t t' : task)                                (* t | t' *)
  | TAllocated (t : task) (vs : list vehicle)              (* t[V] *)
  | TAll_of (bs : list (code * task))
  | TOne_of (bs : list (code * task))
  | TUntil (k : on_cut) (g : code) (t : task)              (* until, assure *)
  | TIdle (n : seconds)
  | TConfirm (x : prompt) (at_site : site)
  | TDuring (k : on_cut) (d : duration) (t : task)         (* during, within *)
  | TWatch (t : task) (h : code)
  | TRepeat (n : option nat) (g : option code) (t : task)  (* n rounds; None: without end *)
  | TMade (a : code)                                       (* { a }: the task that this code gives *)
  | TRecruit (q : filter) (a : code)
  | TFresh (a : code)
  | TKeys (ks : list timer) (a : code) (t : task)          (* fresh { a } that was opened: a gave t of these keys *)
  | TEnsure (t : task) (ds : list end_deed).

  (** Platform tasks, timers (with questions and recruits) and places in a task: how many numbers it takes. *)
  Fixpoint leaves (t : task) : nat :=
    match t with
    | TPlan _ => 1
    | TAction _ | TCondition _ | TIdle _ | TConfirm _ _ | TMade _ | TRecruit _ _ | TFresh _ => 0
    | TSequence a b | TParallel a b => leaves a + leaves b
    | TAllocated a _ | TUntil _ _ a | TDuring _ _ a | TWatch a _ | TRepeat _ _ a | TKeys _ _ a | TEnsure a _ =>
        leaves a
    | TAll_of bs | TOne_of bs => list_sum (map (fun b => leaves (snd b)) bs)
    end.

  (** There is no [allOf] or [oneOf] without a branch, and [may_ensure] holds of all that ends do. *)
  Section Solid.
  Variable may_ensure : end_deed -> bool.
  Fixpoint solid_with (t : task) : bool :=
    match t with
    | TAll_of bs | TOne_of bs =>
        negb (match bs with [] => true | _ => false end) && forallb (fun b => solid_with (snd b)) bs
    | TSequence a b | TParallel a b => solid_with a && solid_with b
    | TAllocated a _ | TUntil _ _ a | TDuring _ _ a | TWatch a _ | TRepeat _ _ a | TKeys _ _ a => solid_with a
    | TEnsure a ds => solid_with a && forallb may_ensure ds
    | TPlan _ | TAction _ | TCondition _ | TIdle _ | TConfirm _ _ | TMade _ | TRecruit _ _ | TFresh _ => true
    end.
  End Solid.
End Syntax.
