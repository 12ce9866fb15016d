(** A vehicle behind its link: bytes in, bytes out, through {!Link_faults} both ways. A pure state machine. *)

open Dolphin_imc

type t

val create : ?faults:Link_faults.t -> seed:int -> Vehicle_node.settings -> t
(** The vehicle's node behind a network with those faults, by default {!Link_faults.none}; [seed] decides which
    datagrams they hit. *)

val node : t -> Vehicle_node.t
(** The vehicle's node. *)

(** The receivers of a datagram. *)
type destination =
  | Discovery  (** those listening for announcements *)
  | System of Address.t

(** A datagram to be sent. *)
type datagram = { destination : destination; bytes : string }

type outcome = datagram list * Activity.t list * t
(** As in {!Vehicle_node.outcome}. *)

val due : t -> float option
(** When something happens by itself: seconds, [None] if nothing does. *)

val advance : at:float -> t -> outcome
(** The events of its own up to that time. *)

val receive : at:float -> Vehicle_node.channel -> host:string -> string -> t -> outcome
(** [receive ~at channel ~host bytes r]. Datagrams that are not IMC packets are dropped. *)

val tell : at:float -> src_ent:int -> content:Packet.content -> t -> outcome
(** See {!Vehicle_node.tell}. *)
