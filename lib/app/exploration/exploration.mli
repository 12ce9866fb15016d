(** All runs of a program in its world, explored. *)

module Search := Dolphin_explore.Search
module Property := Dolphin_explore.Property

(** The world of an exploration, and its bounds. [None] is without a bound. *)
type settings = {
  answers : string list;  (** the possible answers; [[]]: those of the fleet *)
  faults : Dolphin_environment.Faults.t;
  reduction : Dolphin_explore.Reduction.t;
  compress : bool;  (** less memory, more time *)
  spill : string option;  (** the directory for data beyond [max_memory] *)
  walks : Dolphin_explore.Search.walks option;
  bitstate : int option;  (** bytes of bits that distinguish states, in place of their set *)
  workers : int;  (** processes that search, if there are many states *)
  max_states : int option;
  max_depth : int option;  (** transitions *)
  max_memory : int option;  (** bytes; [None]: nine tenths of the memory left to the process *)
  timeout : float option;  (** seconds *)
  invariants : string list;  (** expressions ({!Dolphin_explore.Condition}) *)
  formulas : string list;  (** of linear temporal logic ({!Dolphin_explore.Temporal}) *)
  fairness : Dolphin_explore.Search.fairness;
}

val plain : settings
(** The standard properties, with the answers and faults of the fleet alone, every reduction, in one process, without
    bounds but that on memory. *)

val invariants :
  Dolphin_semantics.Core.program -> string list -> (Dolphin_explore.Condition.t list, Error.t) result
(** [invariants program texts] is the conditions that [texts] spell, or the first that is wrong: {!Error.Bad_input}. *)

val check_violation : settings -> Program_file.t -> string -> (unit, Error.t) result
(** [check_violation s program name] fails with {!Error.Bad_input}, which lists the properties that {!explore} judges,
    if none of them has this {!Property.name}, or if an invariant or a formula of [s] is wrong. *)

val explore :
  ?from:Present.t -> interrupted:(unit -> bool) -> progress:(Dolphin_checker.Limits.progress -> unit) -> settings ->
  Program_file.t ->
  Fleet_file.t -> (Search.outcome, Error.t) result
(** [explore ~from ~interrupted ~progress s program fleet] is the result about the runs of [program] in the world of
    [fleet]: about those that go on from the present [from] of a run, by default about all. It ends early, as at a
    bound, once [interrupted ()]; [progress] is called now and then. The error, {!Error.Bad_input}, is a wrong invariant
    or formula. *)

(** {1:verdicts Verdicts} *)

val is_remark : Property.t -> bool
(** Whether a violation of it is only worth a note unless the check is strict: a program may mean to halt, or to leave
    tuples. *)

(** The verdict on a whole program. *)
type verdict = Dolphin_checker.Verdict.t = Holds | Violated | Inconclusive

val verdict : strict:bool -> Search.outcome -> verdict
(** [verdict ~strict o] is [Violated] if some property is, and else [Inconclusive] if a bound was met; remarks count
    only if [strict]. *)

val counterexample : strict:bool -> Search.outcome -> (Property.t * Search.run) option
(** The first counterexample that {!Exploration_report} shows. *)

val counterexample_of : string -> Search.outcome -> (Property.t * Search.run, Error.t) result
(** The counterexample of the property with this {!Property.name}, also if it is a remark; or an error that lists the
    properties that have one. *)

val draw : Program_file.t -> Fleet_file.t -> Drawing.t -> Property.t * Search.run -> (unit, Error.t) result
(** [draw program fleet drawing (property, run)] draws the counterexample [run], by steps. *)

val write_witness : Program_file.t -> Fleet_file.t -> string -> Property.t * Search.run -> (unit, Error.t) result
(** [write_witness program fleet path (property, run)] writes the counterexample [run] into the file [path], in the
    Informal Trace Format if its name ends in [.itf.json], and else as {!Dolphin_trace.Witness}, which {!Witness_run}
    takes again. *)
