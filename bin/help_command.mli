(** [dolphin help]: what a program says of itself to whoever starts it. *)

val command : others:string list -> Exit_status.t Cmdliner.Cmd.t
(** [command ~others] also shows the manual of itself and the commands [others]. *)
