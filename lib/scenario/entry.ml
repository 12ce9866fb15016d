(** The parts of a scenario: the entries of a fleet file. A types-only module; {!Scenario} includes it. *)

(** Nothing is heard of a vehicle for a while; both in seconds, [lasts] more than 0. *)
type drop = { from : float;  (** since the start *) lasts : float }

type vehicle = {
  id : Dolphin_semantics.Core.vehicle;
  kind : string;  (** ["UUV"], ["UAV"], ... *)
  payload : string list;  (** the devices that it carries *)
  position : Dolphin_geo.Position.t;  (** at the start *)
  speed : float;  (** metres per second, more than 0 *)
  battery : float;  (** at the start, from 0 to 1 *)
  tells_battery : bool;  (** whether it ever reports its charge *)
  drain : float;  (** the share of the battery that an hour's work takes; rest takes a quarter of that *)
  charge : float;  (** the share that an hour's rest gives, instead; 0: it does not charge *)
  chargers : (Dolphin_geo.Position.t * float) list;
  (** if not empty, it charges only within such a distance, in metres, of one of these places *)
  joins : float;  (** seconds since the start *)
  leaves : float option;  (** seconds since the start, after [joins]; [None]: it stays *)
  drops : drop list;  (** in the order of the file *)
  batteries : float list;
  (** if not empty, all that the battery ever shows: at least two, [battery] first. If empty, it shows what is left. *)
  shows : (string * float list) list;
  (** its measurements, by quantity; if several values, all that it ever shows. If none, there are samples of it *)
  places : Dolphin_geo.Position.t list;
  (** if not empty, all places where it is ever seen: at least two, [position] first. If empty, it is seen where it
      is. *)
}

(** How long a plan takes, in seconds: [0 <= least <= most]. *)
type duration = { least : float; most : float }

type ending =
  | Succeeds
  | May_fail of float  (** how often, from 0 to 1; the explorer takes both outcomes *)
  | Fails

(** The outcome of the platform tasks of one name. *)
type plan = {
  name : string;
  duration : duration option;  (** [None]: any time *)
  ending : ending;
  place : Dolphin_geo.Position.t option;  (** its place; [None]: that of the vehicle *)
  only : string list;  (** types and ids of the vehicles that know it; others refuse. [[]]: all know it *)
  charges : float option;
  (** the share of the battery that an hour of it gives, at least 0; [None]: it drains the battery *)
}

(** The answer when a program asks [prompt]: the text of an expression, such as ["2"] or ["'x8-02'"]. *)
type answer = { prompt : string; texts : string list  (** one for each asking, at least one *) }

(** The supplier's reply to [call], named as in labels ({!Dolphin_semantics.Machine.name_of_call}). *)
type reply = {
  call : string;
  rounds : Reply.t list list;
  (** for the first call, the second and so on, at least one: the possible replies then, at least one *)
}

(** The posts of people or programs with [key] while a run goes on. *)
type input = {
  key : string;
  rounds : Dolphin_semantics.Core.value list list;  (** for the first time, the second and so on, as of {!reply} *)
  times : int;  (** how often, at least 1 *)
  after : float option;  (** seconds since the start, or since the time before; [None]: unknown, if at all *)
}

(** A measurement at a place, from a time on. *)
type sample = { quantity : string; value : float; place : Dolphin_geo.Position.t; time : float  (** in seconds *) }

(** An assumption on readings. *)
type recurrence = {
  source : string;  (** the entry, as a fleet file has it *)
  readings : Dolphin_semantics.World.assumption list;
  (** the sensor that it compares shows any of these, or what satisfies this comparison; of an [assume] for each
      vehicle, those of one *)
  at : Dolphin_syntax.Location.t;  (** its place in the file *)
}

type t = {
  vehicles : vehicle list;
  plans : plan list;
  answers : answer list;
  replies : reply list;
  inputs : input list;
  samples : sample list;  (** of the fields of quantities *)
  fences : Dolphin_plans.Fences.fence list;  (** the fences of every program's vehicles *)
  plans_at : Dolphin_geo.Position.t option;  (** the place of inline plans without one of their own or of their
                                                 program *)
  recurrences : recurrence list;
  begins : Dolphin_semantics.Calendar.t option;  (** the date at which runs begin, in the zone *)
  zone : int option;  (** of times of day, in minutes east of UTC; with [begins] it is UTC by default *)
}
(** Vehicles, plans, prompts and calls are unique by their names; all are in the order of the file. *)
