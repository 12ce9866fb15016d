(** The layers of the map: files of the folder that other programs have written. They are read beside the run, which
    does not wait for them. *)

open Exchange
module Request = Dolphin_http.Request
module Response = Dolphin_http.Response

val layer : Hall.t -> Request.t -> (Response.t, refusal) result Lwt.t
(** [GET layer?path=P]: the [shapes] of a map, or of a file of pictures which [tiles] there are. *)

val tile : Hall.t -> Request.t -> (Response.t, refusal) result Lwt.t
(** [GET tile?path=P&zoom=Z&column=X&row=Y]: a picture. *)
