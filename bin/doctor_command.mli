(** [dolphin doctor]: the optional software of this machine, and the missing parts. *)

val command : Exit_status.t Cmdliner.Cmd.t
