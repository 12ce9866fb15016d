(** The letters of the words that runs are to a formula: which of its propositions hold at a position. A letter is made
    of what holds of the transition and of what holds in the state; all three are numbers. *)

open Dolphin_semantics

type t

exception Broken of string
(** A condition in a formula is faulty. *)

val create : Core.program -> World.t -> Proposition.t array -> t

val nothing : int
(** The action where there is no transition, or none of the propositions holds of it. *)

val action : t -> Transition.t -> int

val action_observed : t -> Proposition.observed -> int
(** That of what was observed. *)

val action_of_local : t -> Local_step.t -> int
(** That of the transitions that the local step makes ({!Local_step.conclude}). *)

val state : t -> Configuration.t -> int
(** @raise Broken *)

val asks_states : t -> bool
(** Whether any proposition is of states: otherwise [state] is 0. *)

val letter : t -> int -> int -> int
(** [letter t action state] *)

val holds : t -> int -> int -> bool
(** [holds t letter place] is whether the proposition at this place of the array holds. *)
