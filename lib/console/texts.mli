(** Requests of an editor about a text under way. *)

open Dolphin_json
open Exchange

val check : Workspace.t -> Field.members -> (json, refusal) result
(** [POST check]. *)

val at_place :
  (Dolphin_service.Service.t -> int -> json) -> Workspace.t -> Field.members -> (json, refusal) result
(** [at_place f] is [f] of the text and the place that a request has: [POST complete], [hover], [signature]. *)

val definition : Workspace.t -> Field.members -> (json, refusal) result
(** [POST definition]. *)

val format : Workspace.t -> Field.members -> (json, refusal) result
(** [POST format]. *)

val shapes : Workspace.t -> Field.members -> (json, refusal) result
(** [POST shapes]. *)
