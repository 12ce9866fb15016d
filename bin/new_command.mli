(** [dolphin new]: a mission to start from. *)

val command : Exit_status.t Cmdliner.Cmd.t
