(** A client of HTTP that can also say what no client says. *)

val connect : int -> Lwt_unix.file_descr Lwt.t
(** [connect port] is a connection on which nothing was said yet. *)

val raw : ?no_more:bool -> port:int -> string -> string Lwt.t
(** [raw ~no_more ~port text] is all that comes back for [text] until the server closes, or for half a minute. With
    [no_more] the server is told that nothing follows [text]. *)

type reply = { status : int; body : string }

val ask :
  ?verb:string -> ?headers:(string * string) list -> ?body:string -> port:int -> string -> reply Lwt.t
(** [ask ~verb ~headers ~body ~port path] is a request as a program of this machine sends it; a body is JSON. *)

val json : reply -> Yojson.Safe.t

(** {1:events Events} *)

type watcher

val events : ?headers:(string * string) list -> port:int -> string -> watcher Lwt.t
(** [events ~headers ~port path] reads the events that [path] streams. *)

val watch : ?last:string -> port:int -> string -> watcher Lwt.t
(** [watch ~last ~port name] looks on as [name]. *)

type message = { id : string; event : string; data : string }

val until : watcher -> (message -> bool) -> message list Lwt.t
(** [until w p] is the messages up to the first one that [p] holds of; it fails after a minute. *)

val leave : watcher -> unit Lwt.t
