(** Why bytes are not a packet, and why a packet has no bytes. *)

(** {1:decode Decoding} *)

(** The fault of a payload. *)
type fault =
  | Overrun  (** A field reaches past the end. *)
  | Leftover of int  (** This number of bytes follows the last field: a message of another version. *)
  | Unknown_message of int
  (** A message within the message has this id. Its length is known to no one, so that the rest
      cannot be read. *)
  | Misplaced of { id : int; expected : string }
  (** The message [id] stands where the definition asks for another, or for one of a group. *)
  | Too_deep  (** Messages within messages, more than {!max_depth}. *)

(** The reason why bytes are not a packet. *)
type decode =
  | Too_short of int  (** The number of bytes: fewer than a header and a checksum. *)
  | Not_imc of int  (** The first two bytes, big-endian, are not [0x54FE] nor [0xFE54]. *)
  | Truncated of { stated : int; present : int }
  (** The packet is [stated] bytes long according to its header; [present] are there. *)
  | Surplus of int  (** This number of bytes follows the packet in its datagram. *)
  | Bad_checksum of { stated : int; computed : int }
  | Bad_payload of { id : int; at : int; fault : fault }
  (** The payload of message [id], [at] bytes after the start of the payload. *)

val label : decode -> string
(** A short constant name of the case, to count by: ["bad checksum"]. *)

val pp_decode : Format.formatter -> decode -> unit
(** Without a full stop: ["checksum 1a2b, computed 3c4d"]. *)

(** {1:encode Encoding}

    Fields have IMC's names: ["PlanControl.request_id"]. *)

type encode =
  | Out_of_range of { field : string; value : int }  (** The field's type has no such number. *)
  | Too_long of { field : string; length : int }
  (** Of a text, more than 65535 bytes; of a list, more than 65535 messages. *)
  | Nested_too_deep of { field : string }  (** The receiver would see {!Too_deep}. *)
  | Too_large of { id : int; size : int }  (** More than 65535 bytes of payload. *)

val pp_encode : Format.formatter -> encode -> unit
(** Without a full stop. *)

val max_depth : int
(** How deep messages may contain messages: 16. A plan in its request needs 5. *)
