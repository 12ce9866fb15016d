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
  | Rest of { whole : t; share : float option; plan : t }
  (** [plan] is the part that remains of [whole], which is not a rest, once this share of its way is done, from 0 to 1.
      For analyses of open worlds, the share is [None]: any part up to its end, perhaps all of it, remains, and [plan]
      is the whole, or a rest of it with a known share. *)

val name : t -> string
(** The name in the program, by which journals and vehicles know the plan. *)

val vehicles : t -> string list
(** The only ones that may run it; [[]]: any. *)

val required_payload : t -> string list
(** The devices that it needs, each once. All rests of a plan need those of the whole, so that [explore], which does not
    know which part is left, finds the same vehicles as [exec]. *)

val reference : t -> Position.t option
(** Its beginning, of a rest that of the whole: allocation prefers vehicles near it. [None]: wherever the vehicle is. *)

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

val way_from : t -> Position.t option
(** [way_from p] is a place from which {!path} is the way that shares of [p] count: its places are the same from
    anywhere, but for a last part that comes home, which is of no length from there. [None] if [p] has no such way: it
    goes from wherever the vehicle is. *)

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

val digest : t -> string
(** [digest p] is the same for equal plans only, in 32 hexadecimal digits. *)

val compare : t -> t -> int
(** A total order; plans are equal if all that is written in them is. *)

val pp : Format.formatter -> t -> unit
(** As {!Plan.pp} and {!Mission_plan.pp}. *)

(** {1:rest The rest of a plan} *)

val from_share : float -> t -> t
(** [from_share x p] is the part of [p] that remains once the share [x] of its way is done: a plan of the same name,
    for the same vehicles. [p] itself for [x <= 0]; for [x >= 1], its last place and what takes no time there.

    A share is one of time: that of [path ~speed:1.] from {!way_from}, its first place on. A dwell without end counts 0.
    A way without time is not cut: the rest is [p] itself. So it is if there is no such way.

    The rest begins at the place of the cut. It has all that was not done: a dwell goes on for the seconds that remain,
    in whole seconds, turns in whole turns. It begins with the launch or the last take-off before the cut, as the
    vehicle may have landed since, and with the home, altitude, speed and photos in force. Rows become the points of a
    [followPath], the lines of a [surveyArea] become [goPos] items, and the rounds under way are written out. A mission
    is begun again as a whole, and the rest is [p] itself, if its rounds cannot be told apart: its jumps lead forward
    or cross each other, or it has items with [up] besides its jumps. *)

val some_rest : t -> t
(** [some_rest p] is a rest of [p] that is not known. *)

val any_part : t -> t
(** [any_part p] is the same for [p] and all of its rests, and for no other plan. *)

val begun : t -> string * float option
(** [begun p] is the digest of the whole plan that [p] is a rest of, and the share of it that is done before [p] begins:
    of [p] itself and 0, if it is no rest. *)
