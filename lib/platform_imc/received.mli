(** The messages heard from systems, by type: for people who inspect a vehicle's traffic. *)

open Dolphin_imc

type t

(** Of one message of one system. *)
type entry = {
  count : int;  (** their number *)
  order : Byte_order.t;  (** of the last one *)
  payload : string;  (** of the last one *)
}

val nothing : t
(** No system was heard. *)

val add : Header.t -> string -> t -> t
(** [add h bytes x] is [x] after the packet [bytes] with the header [h]. Of one system {!most_kinds} different messages
    are kept. *)

val forget : int -> t -> t
(** [forget id x] is [x] without what the system [id] sent. *)

val of_system : int -> t -> (int * entry) list
(** [of_system id x] is the messages of the system [id], by the number of the message. *)

val most_kinds : int
(** 1000: IMC has fewer. *)
