(** The room that a plan takes. *)

open Dolphin_geo

(** The cost of a part of the way. *)
type part = {
  leg : string;  (** the maneuver or item *)
  is_transit : bool;  (** from the vehicle's place to the beginning of the plan *)
  stretch : Fence.stretch;
}

val make : from:Position.t option -> Inline_plan.t -> part list
(** [make ~from p] is the room that {!Inline_plan.path} takes, circles as the discs inside of them. If it is not known
    where the vehicle is, only that which does not depend on it. *)

(** How far down or up a maneuver goes, in metres. *)
type vertical =
  | Below_surface of float  (** the depth of its deepest point *)
  | Above of float  (** the height of its highest point, above the ellipsoid; of a mission above home *)
  | At_altitude of float  (** the height of its highest point above the ground: no one knows how deep that is *)
  | Not_told  (** the vehicle keeps its height in its own way *)

val verticals : Inline_plan.t -> (string * vertical) list
(** [verticals p] is that of each maneuver, or of each item that a mission carries out. *)
