(** The number of faults in a run. *)

open Dolphin_semantics
open Dolphin_environment

val of_run :
  tick:(unit -> unit) -> Environment.options -> Core.program -> World.t -> Configuration.t * Environment.t ->
  Transition.t list -> int
(** [of_run ~tick o p w start steps] is how many faults the run [steps] from [start] has in [p], as
    {!Environment.options.most_faults} counts them.
    [tick] is called at each step.
    @raise Invalid_argument if it is not a run *)

val of_deadlock :
  tick:(unit -> unit) -> Environment.options -> Core.program -> World.t -> Configuration.t * Environment.t ->
  Transition.t list -> int
(** [of_deadlock ~tick o p w start steps] is the same with the vehicles that stay away from the deadlock at the end. *)
