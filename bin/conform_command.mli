(** [dolphin conform]: the corpus. *)

val command : Exit_status.t Cmdliner.Cmd.t
