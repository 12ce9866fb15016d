(** The layers of the map: files of the folder that other programs have written. They are read in
    threads of their own: the run goes on meanwhile, and waits for a moment at a time at most. *)

open Exchange
module Request = Dolphin_http.Request
module Response = Dolphin_http.Response

val layer : Hall.t -> Request.t -> (Response.t, refusal) result Lwt.t
(** [GET layer?path=P]: the [shapes] of a map, or of a file of pictures which [tiles] there are. *)

val tile : Hall.t -> Request.t -> (Response.t, refusal) result Lwt.t
(** [GET tile?path=P&zoom=Z&column=X&row=Y]: a picture. *)
