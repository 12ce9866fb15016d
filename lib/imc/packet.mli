(** Packets: a message with its sender, receiver and time; to and from bytes.

    {[
      open Dolphin_imc

      let packet = Packet.make ~src:0x4001 ~dst:26 ~timestamp:1.7e9 (Message.Abort)

      let () =
        let bytes = Result.get_ok (Packet.encode packet) in
        assert (String.length bytes = Header.overhead);
        match Packet.decode bytes with
        | Ok read -> assert (Packet.equal read packet && read.dst = 26)
        | Error _ -> assert false

      let () = assert (Packet.decode "not IMC" = Error (Too_short 7))
    ]} *)

(** The message of a packet. *)
type content =
  | Message of Message.t
  | Unknown of { id : int; payload : string }
  (** A message that {!Message} does not have, as it came. {!Dynamic} can read it if the user has
      its definition. *)

type t = {
  order : Byte_order.t;
  timestamp : float;  (** When it was sent, s since 1970-01-01 00:00 UTC. *)
  src : int;
  src_ent : int;
  dst : int;
  dst_ent : int;  (** Systems and entities: see {!Header.t}. *)
  content : content;
}

val make :
  ?order:Byte_order.t ->
  ?src_ent:int ->
  ?dst:int ->
  ?dst_ent:int ->
  src:int ->
  timestamp:float ->
  Message.t ->
  t
(** [make ~src ~timestamp m] is [m] from the system [src]: little-endian, from and to
    {!Header.any_entity}, to {!Header.nobody} in particular. *)

val id : t -> int
(** The number of its message. *)

(** {1:decoding Decoding}

    These never raise, never read outside the bytes they are given, and keep none of them: texts are
    copies, so that a socket's buffer [b], seen as [Bytes.unsafe_to_string b], can be filled again
    afterwards. They allocate at most 64 bytes for each byte of the packet, and nest at most
    {!Error.max_depth} deep.

    If most packets are not wanted, [Header.read] and then [decode_after] for some is the cheap way: only the header
    of the others is read. *)

val decode : ?pos:int -> ?len:int -> string -> (t, Error.decode) result
(** [decode ~pos ~len s] is the packet that is the [len] bytes of [s] from [pos] (all of [s]): one datagram. It
    checks everything: the conditions of {!Header.read}, that no byte follows the packet, the checksum, and that the
    payload is exactly the fields of its message. *)

val decode_after : ?pos:int -> Header.t -> string -> (t, Error.decode) result
(** [decode_after ~pos h s] is the packet at [pos] of [s], whose header is [h] as read by {!Header.read}
    from the same place. The same checks, but for bytes after the packet, which can be the next
    packet. *)

(** {1:encoding Encoding} *)

val encode : t -> (string, Error.encode) result
(** [encode p] is the bytes of [p] in the order [p.order]: if [decode s = Ok p], then [encode p = Ok s],
    unless a signalling NaN is among the [f32] of [s]. *)

(** {1:showing Showing} *)

val to_json : t -> Yojson.Safe.t
(** [{"timestamp", "src", "src_ent", "dst", "dst_ent", "message"}], the message as by
    {!Message.to_json}; an unknown one is [{"id", "payload"}], in hexadecimal. *)

val pp : Format.formatter -> t -> unit
(** {!to_json}, printed. *)

val equal : t -> t -> bool
(** Whether header and content are the same, numbers that are NaN included. *)
