(** [dolphin sim]: simulated vehicles on the network. *)

val command : Exit_status.t Cmdliner.Cmd.t
