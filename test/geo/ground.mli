(** Areas to try things on, around a place in metres to the east and to the north. *)

open Dolphin_geo

val at : float -> float -> Position.t
val origin : Position.t
val place : float * float -> Position.t
val area : (Area.t, Area.error) result -> Area.t
val polygon : ?holes:(float * float) list list -> (float * float) list -> (Area.t, Area.error) result
val square : float -> float -> float -> (float * float) list
(** [square x y side] has its corner in the south-west at [(x, y)]. *)

val length : Position.t list -> float
val rim : Area.t -> float
(** How long its rims are together. *)

val corners : (float * float) list QCheck2.Gen.t
(** Of polygons of some 100 m that do not cross themselves: stars, and columns of heights that are often the same. *)

val pp_corners : (float * float) list Fmt.t

(** {1 On a plane} *)

val segments : 'a list -> ('a * 'a) list
(** Each element with the one after it. *)

val distance_to : float * float -> (float * float) * (float * float) -> float
(** [distance_to p (a, b)] is how far [p] is from the segment between [a] and [b]. *)
