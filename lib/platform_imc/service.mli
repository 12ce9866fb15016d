(** The services that systems announce.

    Source: IMC, Announce; the services are URLs between semicolons, as in
    ["imc+udp://10.0.10.20:6002/;http://10.0.10.20:8080/dune"]. *)

open Dolphin_imc

(** The address of a socket. *)
type address = { host : Unix.inet_addr; port : int }

val pp_address : Format.formatter -> address -> unit
(** ["10.0.10.20:6002"]. *)

val addresses : string -> address list
(** [addresses services] is the addresses at which the announcing system takes IMC packets over UDP, in order: its
    services [imc+udp://HOST:PORT/]. Those with a path (acoustic links by way of the system) are left out; so are
    those without a numeric IPv4 host or a port. *)

val announced : address list -> string
(** [announced addresses] is the services of a system that takes IMC packets there:
    [addresses (announced xs) = xs]. *)

val kind : names:(int * string) list -> Message.System_type.t -> string
(** ["UUV"], ["USV"], ["UAV"], ["UGV"]; other types by their IMC names, as ["CCU"]. A type that IMC 5.4 does not
    name has its name in [names], or is its number. *)

val is_vehicle : Message.System_type.t -> bool
(** Whether systems of this type run plans: UUV, USV, UAV, UGV, and types that this version of IMC does not know. *)
