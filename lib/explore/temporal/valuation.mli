(** Valuations of a formula's propositions: which of them hold at a position of a run. A valuation combines what holds
    of the transition, the action, with what holds in the state. All three are numbers. *)

open Dolphin_semantics

type t

exception Broken of string
(** A condition in a formula is faulty. *)

val create : Core.program -> World.t -> Proposition.t array -> t

val action : t -> Transition.t -> int
(** [action t x] is the number of what holds of [x]: {!Observer.nothing} if nothing does. *)

val action_observed : t -> Proposition.observed -> int
(** [action_observed t x] is that of what was observed. *)

val state : t -> Configuration.t -> int
(** [state t c] is the number of what holds in [c].
    @raise Broken *)

val asks_states : t -> bool
(** Whether any proposition is of states: otherwise [state] is 0. *)

val valuation : t -> int -> int -> int
(** [valuation t action state] is what holds where [action] leads to [state]. *)

val holds : t -> int -> int -> bool
(** [holds t n place] is whether the proposition at this place of the array holds in valuation [n]. *)
