(** Replies, refusals and arguments of requests. *)

open Dolphin_json

type json = Yojson.Safe.t
(** JSON of any shape. *)

(** {1 Replies} *)

(** Why a request is not done: a status of HTTP, a code that does not change, a sentence, perhaps more. *)
type refusal = { status : int; code : string; message : string; more : Field.members }

val refusal : ?more:Field.members -> int -> string -> string -> refusal
(** [refusal ~more status code message]. *)

val refuse : ?more:Field.members -> int -> string -> string -> ('a, refusal) result
(** {!refusal}, as an error. *)

val bad : string -> ('a, refusal) result
(** [bad message] is [refuse 400 "bad-request" message]. *)

val json : ?status:int -> json -> Dolphin_http.Response.t
(** By default with status 200. *)

val of_refusal : refusal -> Dolphin_http.Response.t
(** The reply with the status of the refusal; its body is an object [error] with the code, the message and what is
    [more]. *)

val of_result : (json, refusal) result -> Dolphin_http.Response.t
(** {!json}, or {!of_refusal}. *)

(** {1 Arguments} *)

val ( let* ) : ('a, 'e) result -> ('a -> ('b, 'e) result) -> ('b, 'e) result
(** [Result.bind], for modules that open this one. *)

val needed : ('a, string) result -> ('a, refusal) result
(** An error is a bad request. *)

val body : Dolphin_http.Request.t -> (Field.members, refusal) result
(** The members of the object that the body is. *)

val get : (json -> ('a, string) result) -> string -> Field.members -> ('a, refusal) result
(** [get read name found] is the member [name], as [read] has it. *)

val optional : (json -> ('a, string) result) -> string -> Field.members -> ('a option, refusal) result
(** {!get}; [None] if the member is missing or [null]. *)

val parameter : Dolphin_http.Request.t -> string -> (string, refusal) result
(** [parameter r name] is the value of [name] in the query. *)

val set : Field.members -> ((string * string) list, refusal) result
(** [set found] is the program's parameters in the member [set], each with the text of its value. *)
