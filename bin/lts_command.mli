(** [dolphin lts]: the state graph of a program for other tools, and graphs compared. *)

val command : Exit_status.t Cmdliner.Cmd.t
