(** [dolphin exec]: runs a program. *)

val command : Exit_status.t Cmdliner.Cmd.t
