(** The codec on random messages, made from the facts and not by the codec. *)

type message = { id : int; wire : wire list; json : Yojson.Safe.t  (** As [Message.to_json] shows it. *) }

and wire
(** A value as it is on the wire, in no particular order of bytes. *)

val message : int -> Facts.message -> message QCheck2.Gen.t
(** [message depth m] is any message [m], with messages in it [depth] deep. *)

val small : message -> bool
(** It fits a packet. *)

val datagram : Dolphin_imc.Byte_order.t -> message -> string
(** The packet with a message. *)

val suite : unit Alcotest.test_case list
