(** A server of HTTP/1.1 whose clients cannot make it wait, grow or stop: heads, bodies and connections are bounded in
    size and time. It knows nothing of Dolphin. *)

type limits = {
  head : int;  (** bytes before the body *)
  body : int;  (** bytes *)
  connections : int;  (** at once; more get a reply with this reason and are closed *)
  rate : int;  (** requests of one address in a second; more get a reply with this reason and are closed *)
  patience : float;  (** seconds until a client speaks, for a whole head and body, for each piece that it reads *)
  idle : float;  (** seconds between requests of one connection *)
}

val limits : limits
(** 16 KiB, 4 MiB, 400 connections, 1,000 requests, 10 seconds, 60 seconds. *)

type t

val start :
  ?limits:limits -> ?address:Unix.inet_addr -> port:int -> (Request.t -> Response.t Lwt.t) -> (t, string) result
(** [start ~limits ~address ~port reply] serves [address], by default the loopback address 127.0.0.1, from now on;
    port 0 is any free one. [reply] may fail: the client gets a reply about an error in the server. The error is the
    reason why the port is not available. From then on SIGPIPE is ignored. *)

val port : t -> int

val connections : t -> int
(** How many there are now. *)

val close : t -> unit Lwt.t
(** Takes no further connections and ends those that there are. *)
