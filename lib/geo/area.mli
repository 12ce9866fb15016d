(** A round area on the ground. *)

type t = {
  centre : Position.t;
  radius : float;  (** metres over the ground, finite, at least 0 *)
}

val make : Position.t -> float -> t option
(** [make centre radius] is the circle of [radius] metres around [centre], or [None] if [radius] is negative or not
    finite. *)

val contains : t -> Position.t -> bool
(** [contains area p] is [Wgs84.distance area.centre p <= area.radius] with a millimetre to spare, which is the
    accuracy of distances: the rim belongs to the area. Heights do not matter. *)

val equal : t -> t -> bool
(** Whether centre and radius are the same. *)

val compare : t -> t -> int
(** [compare] orders by centre, then by radius. *)

val pp : Format.formatter -> t -> unit
(** ["(LATITUDE, LONGITUDE) ^ RADIUS m"]. *)
