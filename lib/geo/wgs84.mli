(** Distances and movements over the ground, on the WGS84 ellipsoid.

    The ground is the ellipsoid itself: heights neither lengthen nor shorten a way. Ways are geodesics, the
    shortest lines, by Vincenty's formulas (1975). On GeographicLib's test set their error is below 0.1 mm, and below
    1 micrometre up to 10 km. One exception:
    between points so nearly opposite on the globe (more than some 19,900 km apart) that the inverse formula does
    not converge, the Earth is taken for a sphere of the mean radius, which errs by up to 0.6 %.

    Functions raise [Invalid_argument] if a number of metres that they are given is not finite. Positions are
    taken to be in range, as {!Position.make} leaves them.

    {[
      open Dolphin_geo

      let () =
        let there = Wgs84.move Place.apdl ~bearing:90. 1000. in
        assert (Float.abs (Wgs84.distance Place.apdl there -. 1000.) < 0.001);
        assert (Float.abs (Wgs84.bearing Place.apdl there -. 90.) < 0.001);
        assert (there.longitude > Place.apdl.longitude)
    ]} *)

val distance : Position.t -> Position.t -> float
(** [distance a b] is the length in metres of the shortest way over the ground from [a] to [b], at least 0.
    [distance a b] and [distance b a] agree to the accuracy above. *)

type vector
(** A position at height 0, as a point of space. *)

val vector : Position.t -> vector
(** [vector p] is [p] at height 0. *)

val chord : vector -> vector -> float
(** [chord (vector a) (vector b)] is the length in metres of the straight line through the earth from [a] to [b]: at
    most [distance a b], and cheap. *)

val bearing : Position.t -> Position.t -> float
(** [bearing a b] is the course, in degrees clockwise from true north, 0 up to but without 360, on which the
    shortest way from [a] to [b] begins; 0 if they coincide. *)

val move : Position.t -> bearing:float -> float -> Position.t
(** [move a ~bearing metres] is the end of the geodesic that leaves [a] on course [bearing] (degrees clockwise from
    north) and is [metres] long, at [a]'s height. A negative length goes the other way. The longitude is greater than
    -180 and at most 180. *)

val displacement : Position.t -> Position.t -> float * float
(** [displacement a b] is the metres to the north and to the east with which {!displace} leads from [a] to [b]. *)

val farthest : float
(** Metres that a way of a program may go at most to the north and to the east, about half the globe. *)

val displace : Position.t -> north:float -> east:float -> Position.t
(** [displace a ~north ~east] is [move a ~bearing metres] with the [bearing] and the [metres] of the vector that
    goes [north] metres to the north and [east] metres to the east: so
    [distance a (displace a ~north ~east) = sqrt (north² + east²)] to the accuracy above, up to half the globe.

    Meridians converge, hence displacing by [d] metres and back misses [a] by about [d² tan latitude / R], [R] being
    the Earth's radius: 0.15 m after 1 km at 45°, 16 m after 10 km. *)

val towards : Position.t -> Position.t -> float -> Position.t
(** [towards a b metres] is the position reached from [a] after [metres] over the ground on the shortest way to [b].
    The height changes evenly on the way. It is [b] itself if [b] is at most that far, and [a] if [metres] is not
    positive. *)

val interpolate : Position.t -> Position.t -> float -> Position.t
(** [interpolate a b share] is [towards a b (share * distance a b)]: [a] for 0 and less, [b] for 1 and more. *)

val along : Position.t list -> float -> Position.t option
(** [along ps metres] is the position after [metres] over the ground on the shortest ways from each of [ps] to the
    next: the first of them if [metres] is not positive, the last if the way is not that long, [None] of none. *)

(** {1:straight Straight lines}

    Through the Earth, and cheap where many distances between the same points are compared. *)

type cartesian
(** A position in the Earth-centred frame. *)

val cartesian : Position.t -> cartesian
(** A position with its height above the ellipsoid, for {!straight}. *)

val straight : cartesian -> cartesian -> float
(** [straight a b] is the length in metres of the straight line from [a] to [b], heights included. On the ground it is
    shorter than {!distance} by less than a metre in 80 km. *)
