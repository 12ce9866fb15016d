(** Requests for the files of the folder. *)

open Dolphin_json
open Exchange
module Request = Dolphin_http.Request

val hash : string -> string
(** [hash text] identifies [text] in requests and replies. *)

val short : string -> (string, refusal) result
(** [short text] is [text], unless it is too long for an editor. *)

val list : Workspace.t -> Request.t -> (json, refusal) result
(** [GET files]. *)

val read : Workspace.t -> Request.t -> (json, refusal) result
(** [GET file]. *)

val save : Workspace.t -> Field.members -> (json, refusal) result
(** [PUT file]. *)
