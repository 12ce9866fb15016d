(** [dolphin fleet]: who is out there. *)

val command : Exit_status.t Cmdliner.Cmd.t
