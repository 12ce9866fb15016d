(** The UDP sockets of a console. *)

exception Cannot of string
(** A port cannot be had; why, for people. *)

val listen :
  host:Unix.inet_addr -> announce_ports:int list -> data_port:int -> Unix.file_descr * Unix.file_descr
(** [listen ~host ~announce_ports ~data_port] is the socket for announcements, on the first free port of
    [announce_ports], and the one for data, on [data_port] (0: any), with room for a tenth of a second of a loud fleet.
    Neither blocks.
    @raise Cannot *)

val speaker : Unix.inet_addr -> Unix.file_descr option
(** A socket whose multicasts and broadcasts leave by the interface with this address, with a time to live of 15. *)

val check_own : Unix.inet_addr -> unit
(** Raises {!Cannot} if no interface of this machine has the address. *)

val join : Lwt_unix.file_descr -> Unix.inet_addr -> interfaces:Unix.inet_addr list -> unit
(** [join socket group ~interfaces] hears the multicasts to [group] that come by [interfaces], as far as that is
    possible. *)

val port_of : Unix.file_descr -> int
(** The port that it is bound to. *)

val close_quietly : Unix.file_descr -> unit
(** Closes it; that it was closed before does not matter. *)
