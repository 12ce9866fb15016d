(** [dolphin platform]: judging adapters. *)

val command : Exit_status.t Cmdliner.Cmd.t
