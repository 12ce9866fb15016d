(** [dolphin tla]. *)

val command : Exit_status.t Cmdliner.Cmd.t
