(** Valuations of a formula's propositions: which of them hold at a position of a run. A valuation combines the
    propositions that hold for the transition, the action, with those that hold in the state. All three are numbers. *)

open Dolphin_semantics

type t

exception Broken of string
(** A condition in a formula is faulty. *)

val create : Core.program -> World.t -> Proposition.t array -> t
(** [create p w propositions] knows no valuation yet. Mutable. *)

val action : t -> Transition.t -> int
(** [action t x] is the number of the propositions that hold for [x]: {!Observer.nothing} if there are none. *)

val action_observed : t -> Proposition.observed -> int
(** [action_observed t x] is the same for an observed part. *)

val state : t -> Configuration.t -> int
(** [state t c] is the number of the propositions that hold in [c].
    @raise Broken *)

val asks_states : t -> bool
(** Whether any proposition is of states: otherwise [state] is 0. *)

val valuation : t -> int -> int -> int
(** [valuation t action state] is the set of propositions that hold where [action] leads to [state]. *)

val holds : t -> int -> int -> bool
(** [holds t n place] is whether the proposition at this place of the array holds in valuation [n]. *)
