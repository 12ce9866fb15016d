(** A formula watched while a state space grows: each state is kept together with what its runs so far leave to be shown
    of the formula's negation, a number of {!Dolphin_ltl.Monitor}. Runs after which the formula cannot be violated any
    more are not followed. *)

open Dolphin_semantics

type t

val create : Core.program -> World.t -> Temporal.t -> t
(** For one state space. *)

val monitor : t -> Dolphin_ltl.Monitor.t
(** Of runs that violate the formula. *)

val letters : t -> Valuation.t

val letter : t -> Encoding.t -> int -> int array -> int
(** [letter t words action key] is the letter of [action] and the state [key].
    @raise Valuation.Broken *)
