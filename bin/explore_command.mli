(** [dolphin explore]: is every run of a program sound? *)

val command : Exit_status.t Cmdliner.Cmd.t
