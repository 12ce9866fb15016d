(** [dolphin doctor]: what of this machine Dolphin may want, and what is missing. *)

val command : Exit_status.t Cmdliner.Cmd.t
