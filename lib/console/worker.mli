(** The process beside the console that reads files, parses programs and computes for requests: the process that
    commands vehicles waits for none of it. A worker does one task after another. On its standard input it reads an
    order, on its standard output it writes a reply, each as frames: four bytes with the length, and as many bytes.

    An order is two frames, {!head} and a body. A reply is a head, for {!response_of}, the frames of its body, and an
    empty frame. *)

(** A task for a worker, with its arguments. *)
type order = {
  task : string;  (** its name in {!Worker}'s table, mostly that of the request of HTTP *)
  workspace : Workspace.t;
  query : (string * string) list;
}

val framed : string -> string
(** [framed text] is [text] with its length before it. *)

val head : order -> string
(** In JSON. *)

val response_of : string -> Dolphin_http.Response.body -> (Dolphin_http.Response.t, string) result
(** [response_of head body] is the response whose head a worker has written. *)

val main : megabytes:int -> unit
(** Serves until standard input ends: the whole of the process. Its memory is limited, it is killed when the console
    dies, and other processes take precedence over it. *)
