(** The ground around a point as a plane: distances and bearings from that point are true (the azimuthal equidistant
    projection of the ellipsoid). Up to 10 km from it, other distances and the directions of straight lines are true to
    a millimetre in 2 km; up to {!reach} to 0.03 %. *)

type t
(** The plane around a point. *)

type point = float * float
(** Metres to the east and to the north. *)

val around : Position.t -> t
(** [around p] is the plane around [p]. The height of [p] does not matter. *)

val origin : t -> Position.t
(** The point around which the plane is, at (0, 0). *)

val between : Position.t list -> t option
(** [between ps] is the plane around the middle of [ps], or [None] if one of [ps] is farther from it than {!reach},
    or [ps] is empty. *)

val reach : float
(** 200 km. *)

val of_position : t -> Position.t -> point
(** [of_position t p] is the point of [p] on [t]; its height is left out. *)

val to_position : t -> point -> Position.t
(** At height 0, with degrees in whole billionths, which are a tenth of a millimetre. *)

val earth_radius : t -> float
(** The radius of the sphere that fits the ellipsoid best at the origin. *)
