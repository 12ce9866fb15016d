(** The surroundings of a program: its fleet, inputs and parameters. *)

open Exchange

val get : Workspace.t -> Dolphin_http.Request.t -> (json, refusal) result
(** [GET world]. *)
