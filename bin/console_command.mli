(** [dolphin console]. *)

val command : Exit_status.t Cmdliner.Cmd.t
