(** What a program runs in. *)

open Exchange

val get : Workspace.t -> Dolphin_http.Request.t -> (json, refusal) result
(** [GET world]. *)
