(** The rims of an area on a plane, with an index by height: a question about a line or a place looks only at the sides
    beside it. *)

(** An upright rectangle: from [left] to [right] and from [low] to [high], in metres to the east and to the north. *)
type box = { left : float; right : float; low : float; high : float }

val box_of : Plane.point -> Plane.point -> box
(** [box_of a b] is the least box around [a] and [b]. *)

val are_near : box -> box -> float -> bool
(** [are_near a b metres] is whether [a] and [b] are at most [metres] apart in either direction. *)

(** A side of a rim. *)
type wall = { low_end : Plane.point; high_end : Plane.point; box : box }

type t

val of_rings : Plane.point array list -> t
(** [of_rings rings] is the rims with these corners, of which there are some. *)

val box : t -> box
(** [box rims] is the least box around [rims]. *)

val has : t -> Plane.point -> bool
(** [has rims p] is whether [p] is inside. *)

val fold : ('a -> wall -> 'a) -> 'a -> t -> 'a
(** [fold f start rims] goes through all walls, each once. *)

val fold_between : ('a -> wall -> 'a) -> 'a -> t -> low:float -> high:float -> 'a
(** [fold_between f start rims ~low ~high] goes through all walls that have a point with [low <= y <= high], some of
    them several times, and perhaps through others. *)
