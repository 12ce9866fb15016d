(** Runs that violate a formula, found in a state space under a {!Product}. *)

open Dolphin_semantics
open Dolphin_environment

(** A run from the initial configuration; [cycle] goes on for ever after [steps], and is empty if they come to an
    end. *)
type run = { steps : Transition.t list; cycle : Transition.t list }

val find : ?tick:(unit -> unit) -> Environment.options -> Core.program -> World.t -> Space.t -> Product.t -> run option
(** [find o p w s watch] is a run that violates the formula of [watch], if there is any in [s]: one through
    [Space.shown s], or else a cycle of [s], all of whose states have been expanded, with a shortest way to it.
    [tick] is called often. *)
