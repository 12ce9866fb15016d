(** [dolphin fleet]: the reachable vehicles. *)

val command : Exit_status.t Cmdliner.Cmd.t
