(** [dolphin step]: the oracle. *)

val command : Exit_status.t Cmdliner.Cmd.t
