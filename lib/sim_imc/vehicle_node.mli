(** One simulated vehicle that speaks IMC: a pure state machine from times and packets to packets.

    It stands for a vehicle with DUNE, as it was measured (DUNE 2026.01):
    - It announces itself every 10 s.
    - It sends to the systems that {!Peers} finds in contact, and to all of them all its messages: telemetry, and
      replies, also those to others. Without a system in contact it is silent.
    - PlanControlState comes every 0.35 s and on change, VehicleState every 0.5 s, EstimatedState every 0.55 s,
      Heartbeat and FuelLevel every second, unless its battery is unknown, and so does what it measures, if IMC has a
      message for that. (Of the last two the rate is assumed.)
    - Heartbeats and PlanControl that come in are sent on to all systems in contact, their senders included.
    - Requests must be for the vehicle's own number or {!Dolphin_imc.Header.broadcast}; they need not come from a system
      in contact, but then the reply is not heard. Messages for others, or not for a vehicle, are ignored.
    - Plans are run by {!Engine}.

    While its link is silent, as the scenario has it, nothing comes in or goes out; the plan goes on.

    Times are seconds since the start, in real time. Time in the scenario and of missions may pass faster. *)

open Dolphin_imc

(** The settings of a vehicle's node. *)
type settings = {
  engine : Engine.settings;
  id : int;  (** its number as an IMC system *)
  addresses : Address.t list;  (** the address that it announces for packets *)
  speed : float;  (** seconds of the mission that pass in a second, more than 0 *)
  announce_period : float;  (** 10 s of real vehicles *)
  contact_period : float;  (** how often it looks for contacts: see {!Peers.empty}. 5 s of real vehicles *)
}

type t

val create : settings -> t
(** At time 0, when the engine's [epoch] is. *)

val id : t -> int
(** Its IMC address. *)

val name : t -> string
(** As other systems see it. *)

(** {1:packets Packets} *)

type destination =
  | Discovery  (** those listening for announcements *)
  | Systems of Address.t list  (** those in contact; at least one *)

(** A packet to be sent, and its receivers. *)
type output = { destination : destination; packet : Packet.t }

type outcome = output list * Activity.t list * t
(** The packets to send, in order, each with a later time stamp than the one before; the log entries; the vehicle
    afterwards. *)

val due : t -> float option
(** When something happens by itself. *)

val advance : at:float -> t -> outcome
(** [advance ~at v] is all that happens by itself until [at]; packets are stamped with [at]. *)

(** The entry of a packet. *)
type channel = Announcements | Data

val receive : at:float -> channel -> host:string -> Packet.t -> t -> outcome
(** [receive ~at channel ~host packet v], [packet] from the address [host]; the events of its own until then come
    first. *)

val tell : at:float -> src_ent:int -> content:Packet.content -> t -> output list * t
(** [tell ~at ~src_ent ~content v] sends other messages to the systems in contact, if any. *)

(** {1:state Its state} *)

val listeners : at:float -> t -> Address.t list
(** The data addresses of the systems in contact. *)

val position : at:float -> t -> Dolphin_geo.Position.t
(** Its place. *)
