(** A server of HTTP/1.1 whose clients cannot make it wait, grow or stop: heads, bodies and connections are bounded in
    size and time. It knows nothing of Dolphin. *)

(** How far a client is known. Clients of one rank take neither places nor requests from those of another. *)
type rank =
  | Unknown  (** it has sent no request yet, or only requests of this rank *)
  | Guest
  | Trusted

type limits = {
  head : int;  (** bytes before the body *)
  body : int;  (** bytes *)
  connections : rank -> int;
  (** at once, of each rank. One more ends the oldest one of the address that has most of that rank; not those of guests
      and trusted clients with a reply under way: if there are only such, it gets a reply with this reason and is
      closed. *)
  rate : int;  (** requests of one rank and address in a second; more get a reply with this reason and are closed *)
  handshakes : int;  (** of TLS, of one address in a second; more connections are closed *)
  unsent : int;
  (** bytes of replies of more than 64 KiB that clients of one rank are reading at once: further ones of this length are
      refused *)
  patience : float;  (** seconds until a client speaks, for a whole head and body, for each piece that it reads *)
  idle : float;  (** seconds between requests of one connection *)
}

val limits : limits
(** 16 KiB, 4 MiB, 100 connections of unknown clients, 150 of guests and 150 of trusted ones, 1,000 requests,
    200 handshakes, 64 MiB, 10 seconds, 60 seconds. *)

type t

val start :
  ?limits:limits -> ?address:Unix.inet_addr -> ?tls:Ssl.context -> ?rank:(Request.t -> rank) -> port:int ->
  (Request.t -> Response.t Lwt.t) -> (t, string) result
(** [start ~limits ~address ~tls ~rank ~port reply] serves [address], by default the loopback address 127.0.0.1, from
    now on; port 0 is any free one. With [tls] connections are encrypted. [rank r] is that of the client that sent [r],
    by default [Trusted]. [reply] may fail: the client gets a reply about an error in the server. The error is the
    reason why the port is not available. From then on SIGPIPE is ignored. *)

val port : t -> int
(** The port that is served: a free one if 0 was asked for. *)

val connections : t -> int
(** How many there are now. *)

val close : t -> unit Lwt.t
(** Takes no further connections and ends those that there are. *)
