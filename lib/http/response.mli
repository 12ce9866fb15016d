(** Replies to requests. *)

(** The body of a reply. *)
type body =
  | Text of string
  | Stream of ((string -> unit Lwt.t) -> unit Lwt.t)
  (** is given what writes a piece of it, and fails once the client is gone or reads too slowly *)

type t = { status : int; headers : (string * string) list; body : body }

val text : ?headers:(string * string) list -> kind:string -> int -> string -> t
(** [text ~headers ~kind status body]: [kind] is the media type. *)

val stream : ?headers:(string * string) list -> kind:string -> ((string -> unit Lwt.t) -> unit Lwt.t) -> t
(** With status 200. *)

val head : keep:bool -> t -> string
(** [head ~keep r] is the part before the body; [keep]: the connection goes on after it. *)
