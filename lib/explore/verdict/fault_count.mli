(** The number of faults in a run. *)

open Dolphin_semantics
open Dolphin_environment

val of_run :
  Environment.options -> Core.program -> World.t -> Configuration.t * Environment.t -> Transition.t list -> int
(** [of_run o p w start steps] is how many faults the run [steps] from [start] has in [p], as
    {!Environment.options.most_faults} counts them.
    @raise Invalid_argument if it is not a run *)

val of_deadlock :
  Environment.options -> Core.program -> World.t -> Configuration.t * Environment.t -> Transition.t list -> int
(** [of_deadlock o p w start steps] is the same with the vehicles that stay away from the deadlock at the end. *)
