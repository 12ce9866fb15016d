(** Requests that begin runs, and steer the one that goes on. *)

open Dolphin_json
open Exchange
module Request = Dolphin_http.Request
module Response = Dolphin_http.Response

(** {1 Beginning} *)

val prepared :
  Session.t -> Access.role -> client:string -> string -> ?query:(string * string) list -> string ->
  (Field.members, Response.t) result Lwt.t
(** [prepared h role ~client task ~query body] is the object that a worker makes of [body] by [task], or its refusal. *)

val start : Session.t -> client:string -> Request.t -> Field.members -> (json, Response.t) result Lwt.t
(** [POST run]. *)

val resume : Session.t -> client:string -> Request.t -> Field.members -> (json, Response.t) result Lwt.t
(** [POST run/resume]. *)

val enact : Session.t -> Field.members -> (json, refusal) result
(** [POST run/counterexample]. *)

(** {1 While it goes on} *)

val stop : Session.t -> string -> Field.members -> (json, refusal) result
(** [stop h client found]: [POST run/stop]. *)

val differences :
  Session.t -> Access.role -> client:string -> Field.members -> (Field.members, Response.t) result Lwt.t
(** [POST run/differences]. *)

val replace : Session.t -> client:string -> Request.t -> Field.members -> (json, Response.t) result Lwt.t
(** [POST run/replace]. *)

val is_addressed : Session.t -> string -> Field.members -> bool
(** [is_addressed h client found] is whether the question that a request answers is addressed to the operator of
    [client], who needs no helm for it then. *)

val answer : Session.t -> string -> Field.members -> (json, refusal) result
(** [answer h client found]: [POST run/answer]. *)

val post : Session.t -> string -> Field.members -> (json, refusal) result Lwt.t
(** [post h client found]: [POST run/post]. *)
