(** An area on the ground: round, or bounded by straight lines. Heights do not matter.

    {[
      open Dolphin_geo

      let at north east = Wgs84.displace Place.apdl ~north ~east
      let square = Result.get_ok (Area.polygon [ at 0. 0.; at 0. 100.; at 100. 100.; at 100. 0. ])
      let pond = Result.get_ok (Area.circle (at 50. 50.) 10.)
      let dry = Result.get_ok (Area.difference square pond)

      let () =
        assert (Area.contains square (at 50. 50.));
        assert (not (Area.contains dry (at 50. 50.)));
        assert (Float.abs (Area.size square -. 10_000.) < 1.);
        assert (Area.polygon [ at 0. 0.; at 0. 100. ] = Error (Few_corners 2))
    ]} *)

(** An area with corners: one or more polygons, perhaps with holes. *)
type shape

type t = private
  | Circle of {
      centre : Position.t;
      radius : float;  (** metres over the ground, finite, at least 0 *)
    }
  | Shape of shape

(** The fault of corners or numbers that make no area. *)
type error =
  | Radius of float  (** negative, or not finite *)
  | Width of float  (** of a corridor: not above 0, or not finite *)
  | Few_corners of int  (** which are different *)
  | Straight  (** all corners are on one line *)
  | Many_corners of int
  | Crossing of int * int  (** the sides that begin at these corners, counted from 1 *)
  | Hole of int * error  (** of the hole of this number, from 1 *)
  | Hole_outside of int  (** a hole that is not within the polygon, or meets another *)
  | Rims  (** rims that cross, or turn the wrong way *)
  | Too_wide  (** some corner is farther from the middle than {!Plane.reach} *)
  | Empty  (** nothing is left *)
  | Intricate  (** too many sides cross *)
  | Parts of int  (** not from 1 to {!most_parts} *)
  | Pieces of int  (** an area to be split that is not connected, but consists of this number of polygons *)
  | Uncut of int  (** no straight cuts into this number of connected parts were found *)

val circle : Position.t -> float -> (t, error) result
(** [circle centre radius] is the circle of [radius] metres around [centre]. *)

val polygon : ?holes:Position.t list list -> Position.t list -> (t, error) result
(** [polygon ~holes corners] is the area enclosed by the shortest lines from corner to corner, and from the last to
    the first, without [holes]. A corner that follows itself counts once. In either order of corners it is the same
    area. Holes that leave nothing of it are an error: {!is_covered}. *)

val is_covered : whole:float -> left:float -> length:float -> bool
(** [is_covered ~whole ~left ~length] is whether holes cover their polygon: they leave at most a hundredth of it, in
    strips less than 10 cm wide, or strips of some millimetres. [whole] and [left] are twice the area of the polygon and
    of the rest, [length] is that of all rims; in millimetres. *)

val most_corners : int
(** 20,000. *)

val corridor : Position.t list -> float -> (t, error) result
(** [corridor path width] has the points at most [width / 2] metres from the way along [path], up to the accuracy
    below for arcs. *)

val of_rings : Position.t list list -> (t, error) result
(** [of_rings (rings area)] is [area]. Invalid rims are an error. *)

val rings : shape -> Position.t list list
(** The rims, each from its corner in the south, of those in the west: counterclockwise around an area, clockwise
    around a hole. They neither cross nor overlap. *)

val on_own_plane : shape -> Plane.t * Plane.point array array
(** [on_own_plane shape] is the plane around the middle of [shape], and its rims there, in the order of {!rings}. *)

(** {1:ask What an area is like} *)

val contains : t -> Position.t -> bool
(** [contains area p] is whether [p] is in the area or on its rim, with a millimetre to spare, which is the accuracy of
    distances. *)

val size : t -> float
(** In square metres; right to a millionth for areas of 10 km, to 0.02 % for the widest. *)

val centre : t -> Position.t
(** A circle's centre, the centre of gravity of others; it may lie outside. *)

val bounds : t -> Position.t * Position.t
(** The south-west and the north-east corner of the least box of latitudes and longitudes that has the area in it. The
    western longitude is greater than the eastern if the box has the meridian of 180 degrees in it, and around a pole
    they are -180 and 180. *)

val corners : t -> Position.t list
(** Of all its rims; of a circle, those of {!operations}. *)

val on_plane : t -> (Plane.t * Arrangement.ring list, error) result
(** [on_plane area] is a plane and the rims of [area] on it, in millimetres. [Error Empty] for a circle without
    radius. *)

(** {1:operations Operations}

    They work in a plane, {!Plane}, on a grid of a millimetre. A circle takes part as a polygon of {!corners_of_circle}
    corners on its rim, which is inside of the circle by at most a 3,300th part of the radius. The arcs of {!corridor}
    and {!offset} have a corner every 11 degrees, and are right to half a percent of their radius; these two take at
    most 500 corners. Results have no parts that are thinner than some millimetres. *)

val corners_of_circle : int
(** 128. *)

val union : t -> t -> (t, error) result
(** The points of either area. *)

val intersection : t -> t -> (t, error) result
(** The points of both areas. [Error Empty] if there are none. *)

val difference : t -> t -> (t, error) result
(** [difference a b] has the points of [a] that are not in [b]. [Error Empty] if there are none. *)

val hull : t list -> (t, error) result
(** The smallest convex area around all of these. *)

val offset : t -> float -> (t, error) result
(** [offset area metres] has the points at most [metres] away from [area]; with a negative number, the points of
    [area] that are at least that far from its rim. *)

val grid : t -> float -> (Position.t list, error) result
(** [grid area metres] are the middles of squares of [metres], laid from the south-west of the area and parallel to
    its middle's meridian, that are in [area], row by row from the south, each from the west. [Error Intricate] if
    there would be more than {!most_points}. *)

val most_points : int
(** 10,000. *)

val split : t -> int -> (t list, error) result
(** [split area n] is [n] parts of [area], each connected: they do not overlap, their union is [area], and their
    sizes differ by at most a millionth and the area of a millimetre along their rims, up to 10 km. Those in the
    south come first. Cuts are straight; {!Division.split} defines them. [split area 1] is [[area]]. *)

val most_parts : int
(** 100. *)

(** {1 Values} *)

val equal : t -> t -> bool
(** Whether centre and radius are the same, or all corners. *)

val compare : t -> t -> int
(** A total order. *)

val hash : t -> int
(** Equal areas have equal hashes. *)

val pp : Format.formatter -> t -> unit
(** ["(LATITUDE, LONGITUDE) ^ RADIUS m"], ["polygon [(LATITUDE, LONGITUDE), ...]"], of {!shown_corners} corners at
    most, ["area of N polygons, M corners"]. *)

val shown_corners : int
(** 8. *)

val pp_error : Format.formatter -> error -> unit
(** One sentence without a full stop. *)
