(** [dolphin walk]: a run by hand. *)

val command : Exit_status.t Cmdliner.Cmd.t
