(** Packet headers, and the bounds of a packet.

    A packet is a header of 20 bytes, a payload of at most 65535, and a checksum of 2:

    {v
offset  0     2    4     6          14   16       17   19       20       20 + size
        sync  id   size  timestamp  src  src_ent  dst  dst_ent  payload  CRC-16/ARC
        u16   u16  u16   f64        u16  u8       u16  u8                u16
    v}

    Source: IMC, packet header and footer. *)

type t = {
  order : Byte_order.t;  (** Of the header and of all that follows. *)
  id : int;  (** Which message: {!Message.id}. *)
  size : int;  (** Bytes of the payload. *)
  timestamp : float;  (** When it was sent by the sender's clock, s since 1970-01-01 00:00 UTC. *)
  src : int;  (** The system that sent it. *)
  src_ent : int;  (** The entity of that system, or {!any_entity}. *)
  dst : int;  (** The system that it is for, {!broadcast}, {!nobody}, or 0 of an announcement. *)
  dst_ent : int;  (** The entity that it is for, or {!any_entity}. *)
}

val size : int
(** 20. *)

val overhead : int
(** 22: the header and the checksum. *)

val broadcast : int
(** [0xFFF0]: the address of all systems. *)

val nobody : int
(** [0xFFFF]: the address of none. *)

val any_entity : int
(** [255]. *)

val read : ?pos:int -> ?len:int -> string -> (t, Error.decode) result
(** [read ~pos ~len s] is the header at the start of the [len] bytes of [s] from [pos] (all of [s]).

    It checks that 22 bytes are there, the first two, and that the packet which the header describes
    is there whole, so that [pos + overhead + size] is in bounds. It does not check the checksum, nor
    that the message is known, nor that the packet is all there is: {!Packet.decode} does. It is for
    deciding by [id], [src], [dst] that a packet is not wanted, at a small cost, and for going through
    packets one after another. Bytes outside [s] count as missing: it never raises. *)

val check : ?pos:int -> t -> string -> (unit, Error.decode) result
(** [check ~pos h s] compares the checksum of the packet at [pos], whose header is [h], as read by
    {!read} from the same place. It never raises: a packet that is not in [s] is [Truncated]. *)

val pp : Format.formatter -> t -> unit
(** ["message 350, 88 bytes, from 0x001a.255 to 0xffff.255 at 1700000000.250"]. *)
