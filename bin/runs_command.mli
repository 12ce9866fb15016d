(** [dolphin runs]: the journals that have their home with the user. *)

val command : Exit_status.t Cmdliner.Cmd.t
