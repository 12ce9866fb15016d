(** [dolphin check]: all that is wrong with a program and its fleet, before anything moves. *)

val command : Exit_status.t Cmdliner.Cmd.t
