(** What a console on the network knows and wants, and how it tells: the state that {!Station} is about. *)

open Dolphin_semantics
open Dolphin_runtime
module Nodes : Map.S with type key = int
module Names : Map.S with type key = string

type settings = {
  id : int;  (** The console's IMC address, from 0x4000 to 0x5FFF, other than those of other consoles. *)
  name : string;  (** As other systems see it. *)
  addresses : Service.address list;  (** Where vehicles can send to, announced to them. *)
  epoch : float;  (** Seconds from 1970-01-01 00:00 UTC to time 0 of our clock. *)
  first_request : int;  (** Where requests are numbered from. *)
  payload : (Core.vehicle * string list) list;  (** Devices of vehicles, in place of their entity lists. *)
  types : (Core.vehicle * string) list;  (** Types of vehicles, in place of what they announce. *)
  type_names : (int * string) list;  (** Of types for which IMC 5.4 has no names. *)
  listens : bool;  (** Whether {!Station.heard} is kept. *)
}

type output =
  | Send of { address : Service.address; bytes : string }  (** From the data port. *)
  | Announce of string
  (** To the announcement ports at 224.0.75.69, the broadcast address and 127.0.0.1. *)
  | Announce_to of Unix.inet_addr * string  (** To the announcement ports there. *)
  | Keep of Core.vehicle * Durable_note.t  (** In case that we die: before what follows is sent. *)
  | Note of Core.vehicle * string  (** For people: something unusual that is not the end of a task. *)

(** {1:state State} *)

(** What is to be done with a vehicle when it is heard of. *)
type wish =
  | Nothing
  | Run of { begun : begun; before : begun option;  (** is to be halted first *) deadline : float }
  | Halt of begun

(** What a console that died was told to have a vehicle do, and what it kept of that; nothing, if it did not ask yet. *)
and begun = { order : Execution.order; memos : Durable_note.t list }

(** What the program was told of a vehicle, and when. *)
type told = { state : World.vehicle_state; at : float }

type t = {
  settings : settings;
  nodes : Node.t Nodes.t;
  ids : int Names.t;
  bound : unit Names.t;
  telemetry : bool;
  timeouts : float Names.t;
  timeout : float;  (** of vehicles that are not in [timeouts] *)
  timers : Timers.t;
  told : told Names.t;
  expected : wish Names.t;  (** vehicles of a console that died *)
  outbox : Outbox.t;
  next_announce : float;
  last_announce : float;
  next_heartbeat : float;
  next_eager : float;
  dropped : int Names.t;
  skipped : int;
  accepted : int;
  heard : Received.t;
}

val create : settings -> t
(** As {!Station.create}. *)

val timeout_of : Core.vehicle -> t -> float
(** The connection timeout of a vehicle, in seconds. *)

val find : Core.vehicle -> t -> Node.t option
(** The system of that name, if it has announced itself. *)

val put : Node.t -> t -> t
(** [put n s] is [s] with [n] in place of what was known of it. *)

val state_of : now:float -> Node.t -> t -> World.vehicle_state
(** [state_of ~now n s] is [n] as programs see it. *)

(** {1:sending Sending} *)

val encode : now:float -> dst:int -> Dolphin_imc.Message.t -> t -> (string, Dolphin_imc.Error.encode) result
(** The bytes of a packet of ours to the system [dst], stamped with the time [now]. *)

val to_node : now:float -> Node.t -> Dolphin_imc.Message.t -> t -> output list
(** Nothing if it has no address. *)

val announcement : now:float -> t -> string
(** Of the console. *)

(** {1:telling Telling the program} *)

val push : Platform.event -> t -> t
(** Puts an event into the outbox. *)

val tell : ?urgent:bool -> now:float -> Node.t -> t -> t
(** [tell ~urgent ~now n s] tells what is new of [n]: what changes at once if it changed, or [urgent]; positions and
    batteries once a second if the program wants them. *)

val carry_out : now:float -> Node.t -> Execution.output list -> t -> t * output list
(** [carry_out ~now n outputs s] is what follows from the execution on [n], which is in [s]. *)

val command : now:float -> Execution.input -> Node.t -> t -> t * output list
(** [command ~now i n s] gives [i] to the execution on [n]. *)
