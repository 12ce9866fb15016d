(** Runs that violate a formula, transition by transition. *)

open Dolphin_semantics
open Dolphin_environment

(** A run from the initial configuration; [cycle] repeats without end after [steps], and is empty if the run is
    finite. If the violation is known before, or by resting there, it is so after [decided] steps. *)
type run = { steps : Transition.t list; cycle : Transition.t list; decided : int option }

val of_violation :
  tick:(unit -> unit) -> Environment.options -> Core.program -> World.t -> State_graph.t -> Labelling.t ->
  Dolphin_checker.Breadth_first.violation -> run
(** [of_violation ~tick o p w g l v] is a run through the states of [v], found in [g] under the monitor of [l], or
    through states that these represent up to the names of vehicles. Then it may go several times around [v]. It calls
    [tick] at each choice that it looks at, and raises what that raises. *)
