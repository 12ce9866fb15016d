(** Checks that several suites make. *)

open Dolphin_imc

val json : Yojson.Safe.t Alcotest.testable

val get : pp:(Format.formatter -> 'e -> unit) -> string -> ('a, 'e) result -> 'a
(** [get ~pp what r] is the value of [r]; an error fails the test. *)

val decoded : string -> Packet.t
val encoded : Packet.t -> string

val message_json : Packet.t -> Yojson.Safe.t
(** The message of a packet that has a known one. *)

val other_order : Packet.t -> Packet.t
