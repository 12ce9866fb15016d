(** The command [dolphin console-worker], for [dolphin console] alone. *)

val command : Exit_status.t Cmdliner.Cmd.t
