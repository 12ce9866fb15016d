(** [dolphin help]: the description of a program for its user. *)

val command : others:string list -> Exit_status.t Cmdliner.Cmd.t
(** [command ~others] also shows the manual of itself and the commands [others]. *)
