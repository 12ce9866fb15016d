(** [dolphin replace]: another program for a run that goes on. *)

val command : Exit_status.t Cmdliner.Cmd.t
