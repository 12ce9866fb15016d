(** Formulas of linear temporal logic, checked of every run of a program. A position of a run is a state together with
    the transition that led to it. A run that comes to an end, or cannot go on, stays in its last state for ever,
    without transitions.

    Every run without end is fair (see {!Cycle}): so a formula holds of the program if it holds of every path of its
    state graph. No reduction is used: propositions see every transition. *)

open Dolphin_semantics

type t

val of_string : Core.program -> string -> (t, string) result
val to_string : t -> string

(** {1:graph The state graph}

    Explored once for all formulas, breadth first over configurations. *)

type graph

exception Broken of string
(** A condition in a formula is faulty. *)

val explore : ?tick:(int -> unit) -> Environment.options -> Core.program -> World.t -> t list -> graph
(** [tick n] is called when state [n] is about to be expanded; it may raise.
    @raise Broken also. *)

(** {1:check To check} *)

(** A run of which a formula does not hold; [cycle] is empty if [steps] come to an end. *)
type run = { steps : Transition.t list; cycle : Transition.t list }

val violation : ?tick:(unit -> unit) -> graph -> t -> run option
(** [violation g f] is a run of which [f] does not hold, if there is any. [f] is one of those that [g] was made for.
    [tick] is called for each state of the product with the formula's automaton. *)
