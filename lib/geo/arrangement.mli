(** Regions of a plane that are bounded by straight lines, on a grid of whole numbers: exact but for the rounding of the
    points in which lines cross. *)

type point = int * int
(** [x] and [y]; both at most {!widest} in size. *)

type ring = point array
(** Corners in order; the last is followed by the first. Counterclockwise, it is the rim of the area that it
    encloses; clockwise, that of a hole. *)

val widest : int
(** 500,000,000: products of such numbers stay exact. *)

(** {1 Simple rings} *)

type flaw =
  | Few  (** fewer than three corners, or all on one line *)
  | Crossing of int * int  (** the sides that begin at these corners cross or touch *)

val flaw : ring -> flaw option
(** [flaw ring] is the reason why [ring] is not simple. No corner of [ring] equals the next. *)

val doubled_area : ring -> int
(** [doubled_area ring] is twice the area inside, negative if [ring] is clockwise. *)

val length : ring -> float
(** [length ring] is how long its sides are together. *)

val hull : point list -> ring
(** [hull ps] is the smallest convex ring around [ps], counterclockwise; of fewer than three corners if [ps] are on one
    line. *)

(** {1 Regions}

    A region is a list of rings. It has the points around which its rings turn, in sum: so rings that overlap are
    united, and a hole is left out. *)

val combine : (bool -> bool -> bool) -> ring list -> ring list -> ring list option
(** [combine f a b] is the region of the points [p] with [f (a has p) (b has p)], where [f false false] is false:
    rings that neither cross nor overlap, without corners on a straight side, and without slivers of a width of a few
    units. [None] if there are too many crossings: more than {!most_sides} sides would arise. *)

val most_sides : int
(** 100,000. *)
