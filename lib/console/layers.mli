(** The layers of the map: files of the folder that other programs have written. *)

open Exchange
module Request = Dolphin_http.Request
module Response = Dolphin_http.Response

val layer : Workspace.t -> Request.t -> (Response.t, refusal) result
(** [GET layer?path=P]: the [shapes] of a map, or of a file of pictures which [tiles] there are. *)

val tile : Workspace.t -> Request.t -> (Response.t, refusal) result
(** [GET tile?path=P&zoom=Z&column=X&row=Y]: a picture. *)

val import : Workspace.t -> Dolphin_json.Field.members -> (json, refusal) result
(** [PUT layer]: a map that was not in the folder. *)
