(** [dolphin plan]: the inline plans of a program as IMC vehicles get them. *)

val command : Exit_status.t Cmdliner.Cmd.t
