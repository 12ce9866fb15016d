(** The names of requests, which adapters know them by. *)

open Dolphin_semantics

val make : run:string -> number:int -> Core.vehicle -> Core.platform_task -> string
(** [make ~run ~number v task] is the request that starts [task] on [v] by transition [number] of the run of this
    identity: the same for each console that resumes the run, and another one for another run, number, vehicle or plan.
    It has at most 64 characters. *)
