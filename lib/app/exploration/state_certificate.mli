(** Certificates: all states of a program with their transitions, in a file, for the checker that is extracted from
    [proofs/] ([docs/proofs.md]). *)

(** The question, and the size of the answer. *)
type header = {
  program : Dolphin_trace.Header.source;
  fleet : Dolphin_trace.Header.source option;  (** [None]: the built-in fleet *)
  answers : string list;  (** as in {!Exploration.settings} *)
  faults : Dolphin_environment.Faults.t;
  holds : Dolphin_explore.Property.t list;  (** of {!certifiable} *)
  states : int;
  transitions : int;
}

(** A transition: its label, and the place of the state that it leads to. [digest] is that of this state
    ({!val-digest}), where transitions with this label lead to several states. *)
type edge = { label : string; target : int; digest : int option }

type t = {
  header : header;
  edges : edge list array;  (** by state, the initial one first *)
}

val holding : Dolphin_explore.Search.outcome -> Dolphin_explore.Property.t list
(** [holding o] is those of {!certifiable} that hold in all states, also in those that no world reaches. *)

val certifiable : Dolphin_explore.Property.t list
(** The properties that a checker sees in a state and its transitions. *)

val digest :
  Dolphin_semantics.Core.program -> Dolphin_semantics.Configuration.t * Dolphin_environment.Environment.t -> int
(** [digest p (c, e)] is a number for [c], its control as it is printed, and [e]. *)

val edges :
  ?workers:int -> Dolphin_checker.Limits.t -> Dolphin_environment.Environment.options ->
  Dolphin_semantics.Core.program -> Dolphin_semantics.World.t ->
  (edge list array, Dolphin_explore.Transition_system.problem) result
(** [edges ~workers limits o p w] is the [edges] of [p] in [w]. *)

val make :
  interrupted:(unit -> bool) -> progress:(Dolphin_checker.Limits.progress -> unit) -> Exploration.settings ->
  Program_file.t -> Fleet_file.t -> Dolphin_explore.Search.outcome -> (t, Error.t) result
(** [make ~interrupted ~progress s program fleet outcome] is the states of [program] in the world of [fleet] and of [s],
    without reduction, with the properties that hold in [outcome]. It fails if a bound of [s] is met. *)

val write : string -> t -> (unit, Error.t) result
(** [write path c] replaces the file [path] by [c], as lines of JSON: the header with the labels, then for each state
    the list of its transitions: [[[3,17]]] has label 3 and leads to state 17, [[[3,17,96]]] with a digest. *)

val read : string -> (t, Error.t) result
(** [read path] is the certificate in the file [path]; {!Error.Bad_input} names the line that is wrong. *)
