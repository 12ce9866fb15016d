(** Ways of many points. *)

val simplified : tolerance:float -> Position.t list -> Position.t list
(** [simplified ~tolerance ps] is the first and the last of [ps], and those between without which the way from each to
    the next would leave out one of [ps] by more than [tolerance] metres over the ground (Douglas and Peucker 1973): so
    corners stay. At most O(1000 n): of longer ways every thousandth point stays too. *)
