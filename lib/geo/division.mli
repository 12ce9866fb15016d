(** Connected regions divided by straight cuts. *)

(** The reason why a region cannot be divided. [Intricate]: it has too many trapezoids ({!Slabs.most_trapezoids}). *)
type failure =
  | Pieces of int  (** the region is not connected: of how many pieces it is *)
  | No_cut  (** no straight cut was found that leaves connected parts *)
  | Intricate

val split : Arrangement.ring list -> int -> (Arrangement.ring list list, failure) result
(** [split region n] is [n] parts of [region] that are equally large but for the rounding of corners to the grid, and
    connected: they have more than corners in common. The parts do not overlap, and [region] is their union. [n] is at
    least 1.

    A cut divides [n] parts into [k] and [n - k], with [k] as near to a half of [n] as it can be, and is the shortest
    of those that were tried: in 12 directions and those of the longest sides; if none of them will do, in all whole
    degrees and those of more sides (in every fifth degree for more than 300 corners). A cut that leaves a part with
    a narrow neck is taken only as the last choice. *)

val directions : evenly:int -> sides:int -> Arrangement.ring list -> float list
(** [directions ~evenly ~sides region] are [evenly] directions with equal angles between them, and those of the
    [sides] longest sides of [region]: radians, from a thousandth below 0 to a thousandth below a half turn. *)

val is_large : Arrangement.ring list -> bool
(** Of more than 300 corners. *)
