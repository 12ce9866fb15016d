(** [dolphin parse]: a program in its canonical form. *)

val command : Exit_status.t Cmdliner.Cmd.t
