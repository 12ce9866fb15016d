(** The positions that matter to a program: those it names, and those of the vehicles, with the distances between them.
    An area with corners is a place too, at a distance of 0 from the positions in it and far away from others. Mutable
    while a program is translated. *)

module Position = Dolphin_geo.Position

type t

val create : unit -> t
(** No position. Mutable. *)

val index : t -> Position.t -> int
(** [index ps p] is the number of [p] in [ps], from 1; it is added if it is not there yet. *)

val index_of_shape : t -> Dolphin_geo.Area.t -> int
(** [index_of_shape ps area] is the number of [area] in [ps]; it is added if it is not there yet. *)

val positions : t -> Position.t list
(** Without areas, in the order of their numbers. *)

val texts : t -> Tla.t
(** The places as messages show them. *)

val distances : t -> Tla.t
(** A row for each place: the distances over the ground to each place, in millimetres, rounded up; at most TLC's
    greatest whole number. *)
