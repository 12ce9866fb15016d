(** The plans of a program and of its fleet, before anything runs. *)

open Dolphin_json
open Exchange

val prepare : Workspace.t -> Field.members -> (json, refusal) result
(** [prepare w found] is the [arguments] of the command [dolphin plan --json] that [POST plans] asks for with [found],
    and [vehicles], the names of the plans that each vehicle of the fleet knows. *)

val list : dolphin:string -> Field.members -> (string, refusal) result Lwt.t
(** [list ~dolphin prepared] is the reply in JSON: the output of that command, in a process of its own, and [vehicles].
    One such process runs at a time, for {!longest} at most. *)

val longest : float
(** 20 seconds. *)
