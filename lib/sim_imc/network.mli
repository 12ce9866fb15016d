(** Simulated vehicles on the network: sockets and a clock around {!Radio}.

    Every vehicle has a data port of its own, and all share one discovery port, on which they hear consoles. Real
    vehicles have one discovery port each, of which a host has five. *)

open Dolphin_scenario

(** The options of a simulated network. [strict] is that of {!Engine.settings}, [faults] are those of every link. *)
type settings = {
  scenario : Scenario.t;
  seed : int;
  speed : float;
  faults : Link_faults.t;
  strict : bool;
  refuses : (string * string) list;  (** vehicles and why they refuse every START *)
  blocks : (string * (float * float)) list;
  (** vehicles, since when and for how long they are BLOCKED, by the clock of the mission *)
  stalls : (string * (float * float)) list;
  (** vehicles, since when and for how long they stall: nothing is heard of them, and then their plan is lost *)
  vanishes : (string * (float * float)) list;
  (** vehicles whose link is silent in both directions, since when and for how long; [infinity]: to the end *)
  announce_period : float;
  contact_period : float;  (** see {!Vehicle_node.settings} *)
  first_id : int;  (** the number of the first vehicle as an IMC system; those of others follow *)
  first_port : int;  (** the first candidate for free data ports *)
  discovery_ports : int * int;  (** first and last: the first free one is ours, announcements go to all others *)
  address : string option;
  (** The address of this host in a network whose hosts are to find the vehicles: they then announce it, besides
      127.0.0.1, by multicast and broadcast too. Otherwise only programs on this host find them. *)
  flood : float;  (** further datagrams a second from each vehicle that has a listener *)
}

val default : Scenario.t -> settings
(** As vehicles are: no faults, speed 1, ports 30100 to 30104 and from 6002, numbers from 0x3001, on this host. *)

type t

val create : ?clock:Dolphin_runtime.Clock.t -> settings -> (t, string) result
(** [create ~clock s] has all sockets that it needs; the error is one sentence. Time starts in {!run}, by [clock] (by
    default {!Dolphin_runtime.Clock.system}); packets are stamped with the date then, and the time since. *)

(** A vehicle as systems know it: its name, its type, its IMC address and the port of its data. *)
type vehicle = { name : string; kind : string; id : int; port : int }

val vehicles : t -> vehicle list
(** In the scenario's order. *)

val run : log:(Yojson.Safe.t -> unit) -> until:unit Lwt.t -> t -> unit Lwt.t
(** [run ~log ~until n] lets the vehicles live until [until] is resolved; [log] takes each {!Activity}. To be called
    once. *)

val close : t -> unit
(** Closes the sockets. *)
