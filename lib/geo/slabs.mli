(** A region of a plane cut into trapezoids, along parallel lines through all of its corners. Its points are turned
    first, so that these lines run to the right, and put on a grid of whole numbers. *)

(** A side that leads upwards, each point as numbers to the right and up. *)
type side = { low : float * float; high : float * float }

val at : side -> float -> float
(** [at side y] is how far to the right [side] is at the height [y]. *)

(** The region between two sides, [left] and [right], at the heights of one layer. *)
type trapezoid = { left : side; right : side }

val width : trapezoid -> float -> float
(** [width t y] is how wide [t] is at the height [y]. *)

val size_up_to : trapezoid -> float -> float -> float
(** [size_up_to t low y] is the size of the part of [t] between the heights [low] and [y]. *)

type t = {
  heights : float array;  (** in order *)
  layers : trapezoid array array;  (** [layers.(i)] are between [heights.(i)] and [heights.(i + 1)], from the left *)
}

val make : angle:float -> Arrangement.ring list -> t option
(** [make ~angle rings] is the region that [rings] bound, seen so that the direction [angle] (radians, counterclockwise
    from the first axis) leads to the right. [None] if there are more than {!most_trapezoids}. *)

val most_trapezoids : int
(** 300,000. *)

val back : angle:float -> float * float -> float * float
(** [back ~angle p] is the original place of the point [p], as seen by {!make}. *)

val meetings : trapezoid array -> trapezoid array -> float -> (int * int) list
(** [meetings a b y] are the [(i, j)] for which [a.(i)] and [b.(j)] have more than a unit in common at the height [y].
    Each of [a] and [b] is in order from the left. *)
