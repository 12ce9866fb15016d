(** A language server without its streams: messages of the Language Server Protocol in, messages out. *)

type json = Yojson.Safe.t
(** A message, or a part of one. *)

type t

val make : version:string -> read:(string -> string option) -> t
(** [make ~version ~read] is a server that no client has talked to; [read path] is the contents of the file [path], if
    there is one: for fleets that are not open in the editor. *)

val handle : t -> json -> t * json list
(** [handle s m] is [s] after the message [m], and the messages that it sends then, in order. A request gets an
    answer, at least an error; nothing raises. *)

val not_json : json
(** The reply to text that is not JSON. *)

val ended : t -> int option
(** [ended s] is the status to end with, once the client has asked for that: 0 after it had asked to shut down, else
    1. *)
