(** The command [dolphin successors]. *)

val command : Exit_status.t Cmdliner.Cmd.t
