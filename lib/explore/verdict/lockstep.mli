(** Runs of a program from those of another one that goes in step with it: that has as many transitions in each
    configuration, in the same order, as {!Alike_values.unify} makes it. *)

open Dolphin_semantics
open Dolphin_environment

(** A run: the steps, and a cycle that repeats without end after them, unless it is empty. *)
type run = { steps : Transition.t list; cycle : Transition.t list }

val follow :
  tick:(unit -> unit) -> Environment.options -> World.t -> Core.program -> image:Core.program ->
  ends_alike:(Transition.t -> Transition.t -> bool) -> run -> run option
(** [follow ~tick o w p ~image ~ends_alike run] is the run of [p] that goes in step with [run], one of [image], and ends
    alike. A cycle is followed around until it returns to the same place in [p]. [None]: they do not go in step. It
    calls [tick] at each choice, and raises what that raises. *)
