(** The destination of the packets for a system, by its Announce. *)

type t = {
  host : string;  (** an IPv4 address in decimals, ["127.0.0.1"] *)
  port : int;
}

val is_host : string -> bool
(** [is_host text] is whether [text] is an IPv4 address in decimals. *)

val of_services : string -> t list
(** [of_services s] is the addresses in the services [s] of an Announce, separated by [;], that take IMC over UDP:
    those of the form ["imc+udp://HOST:PORT/"]. With a path behind they are for other uses. Unreadable parts are left
    out. *)

val to_service : t -> string
(** [to_service a] is ["imc+udp://HOST:PORT/"]. *)
