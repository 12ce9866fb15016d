(** A program's description in place of a plan's name: a plan of maneuvers or a mission of items.

    {[
      open Dolphin_geo
      open Dolphin_plans

      let maneuver kind id location =
        { Plan.id; kind; location; speed = (2., Metres_per_second); z = (3., Depth); payloads = [] }

      let home = Place.apdl
      let out = Wgs84.displace home ~north:1000. ~east:0.
      let stay = Plan.Loiter { radius = 20.; duration = 60.; direction = Clockwise }

      let plan =
        { Plan.name = "out"; description = ""; vehicles = [];
          maneuvers = [ maneuver Go_to "1.Goto" out; maneuver stay "2.Loiter" out ] }

      let () =
        let extent = Inline_plan.extent ~from:home ~speed:1.5 (Maneuvers plan) in
        assert (Float.round extent.metres = 1000. && Float.round extent.moving = 500. && extent.staying = 60.)
    ]} *)

module Position = Dolphin_geo.Position

type t =
  | Maneuvers of Plan.t  (** [imcPlan { ... }] *)
  | Mission of Mission_plan.t  (** [mission { ... }] *)

val name : t -> string
(** The name in the program, by which journals and vehicles know the plan. *)

val vehicles : t -> string list
(** The only ones that may run it; [[]]: any. *)

val required_payload : t -> string list
(** The devices that it needs, each once. *)

val reference : t -> Position.t option
(** Its beginning: allocation prefers vehicles near it. [None]: wherever the vehicle is. *)

(** A part of the way, the maneuver or item [named]: straight to each of [waypoints], then [dwell] seconds at the last,
    perhaps [infinity], or at most [radius] metres from it. *)
type leg = {
  named : string;
  waypoints : Position.t list;
  level : Plan.level;
  speed : float;
  dwell : float;
  radius : float;
}

val path : from:Position.t -> speed:float -> t -> leg list
(** [path ~from ~speed p] is the way of a vehicle at [from], with [speed] where [p] has no speed in metres per
    second: that of {!Plan.path} or {!Mission_plan.path}. *)

val is_stay : leg -> bool
(** Whether it visits no place. *)

val is_fixed : t -> bool
(** [is_fixed p] is whether the places of {!path} are the same wherever the vehicle is. *)

(** The totals of a way. *)
type extent = {
  metres : float;  (** over ground *)
  moving : float;  (** seconds under way *)
  staying : float;  (** seconds of staying, perhaps [infinity] *)
}

val extent : from:Position.t -> speed:float -> t -> extent
(** [extent ~from ~speed p] is that of [path ~from ~speed p], from [from] on until the first stay without end. If
    [speed] is [nan], results that depend on it are so too. *)

val start : t -> (Position.t * float) option
(** [start p] is the first place of {!path} and the speed on the way there, [nan] if that is the vehicle's; [None]
    without one, or if it depends on the vehicle's place. *)

val compare : t -> t -> int
(** A total order; plans are equal if all that is written in them is. *)

val pp : Format.formatter -> t -> unit
(** As {!Plan.pp} and {!Mission_plan.pp}. *)
