(** The limits of vehicles: where plans may lead, and how near to each other vehicles may come. A program declares
    fences. Nothing of this is part of the rules: a plan that breaks a fence fails, as plans may. *)

open Dolphin_geo

(** A limit to all plans and vehicles. *)
type rule =
  | Inside of Area.t
  | Outside of Area.t
  | Depth of float  (** metres below the surface, at most *)
  | Height of float  (** metres above the ellipsoid, the ground or home, at most *)
  | Distance of float  (** metres between vehicles under way, at least *)

val equal_rule : rule -> rule -> bool
(** Whether kinds and limits are the same; areas by {!Area.equal}. *)

(** A rule as a program or a fleet declares it. *)
type fence = {
  rule : rule;
  margin : float;  (** metres that plans keep from it, at least 0 *)
  text : string;  (** as it is declared: ["fence inside harbour, margin: 20.m"] *)
  at : Dolphin_syntax.Location.t;
}

type t
(** Fences, ready to be asked. *)

val none : t
(** No fence: nothing breaks it. *)

val is_none : t -> bool
(** Whether there is no fence. *)

val make : fence list -> t
(** [make fences] is [fences], made ready once for all plans and vehicles. *)

val list : t -> fence list
(** The fences, in the order of {!make}. *)

val least_distance : t -> fence option
(** The greatest of the least distances between vehicles. *)

(** {1 Plans} *)

(** The place where a plan breaks a fence, and how. *)
type breach = {
  fence : fence;
  maneuver : string option;  (** [None]: on the way to the plan *)
  place : Position.t option;  (** [None]: it goes too deep or too high *)
  message : string;  (** the maneuver and the fence that it breaks, the place, and the metres: a sentence without a
                         full stop *)
}

val of_plan : t -> from:Position.t option -> Inline_plan.t -> breach option
(** [of_plan fences ~from p] is the breach that [p] is, of a vehicle at [from], circles taken as the discs inside of
    them: a maneuver that leaves an area, comes nearer to its rim than the margin, or goes too deep or too high, or
    whose depth or height cannot be known. [None] without a breach up to {!Fence.tolerance}. If the vehicle's place
    is unknown, only parts that do not depend on it are checked. On the way to its plan a vehicle may come back from
    beyond a fence, or from within its margin. *)

(** {1 Plans side by side} *)

(** The place where two plans come nearer to each other than the least distance between vehicles. *)
type near = {
  maneuver : string;  (** of the one plan *)
  other : string;  (** of the other *)
  place : Position.t;  (** on the way of the one *)
  metres : float;  (** between the two *)
}

val near : t -> Plan_room.part list -> Plan_room.part list -> near option
(** [near fences ps qs] is the place where the ways [ps] and [qs] are nearest to each other, at any times of the
    vehicles, if that is nearer than the least distance. *)

(** {1 Vehicles} *)

(** The place of a vehicle, as far as it reports it. *)
type sight = {
  place : Position.t;
  depth : float option;  (** metres below the surface *)
  altitude : float option;  (** metres above the ground, or above where it took off *)
}

type beyond
(** Which areas and limits a vehicle breaks, whatever the margin, and by how many metres. *)

val beyond : t -> sight -> beyond
(** Those that a vehicle there breaks. The depth is the reported one; the height is its altitude, or if it reports
    neither altitude nor depth, that of its place above the ellipsoid. *)

val nowhere : beyond
(** None. *)

val of_vehicle : t -> since:beyond -> sight -> (beyond, string) result
(** [of_vehicle fences ~since s] is the breach if a vehicle under way is at [s]: it breaks an area or a limit that it
    did not break, as [since] has it, or by {!leeway} or {!vertical_leeway} metres more. If nothing is wrong, that
    which is still broken of [since]. *)

val leeway : float
(** 10: on its way back, a vehicle may turn. *)

val vertical_leeway : float
(** 2: the metres that it may get deeper or higher on its way back. *)

type under_way = {
  vehicle : string;
  plan : string;
  parts : Plan_room.part list;  (** [[]]: not known *)
}
(** The present activity of a vehicle. *)

val beside : t -> under_way -> under_way list -> string option
(** [beside fences u others] is which of [others] the way of [u] comes nearer to than the least distance between
    vehicles, whenever the two are there: the nearest one. *)

val too_near : t -> (string * Position.t) list -> (string * string * string) list
(** [too_near fences vehicles] is the pairs of [vehicles], each at its place, that are nearer to each other than the
    least distance, each pair once and in order, with its message. *)
