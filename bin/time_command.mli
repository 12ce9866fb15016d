(** [dolphin time]: how early and how late is a program over? *)

val command : Exit_status.t Cmdliner.Cmd.t
