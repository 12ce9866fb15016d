(** Lists gone through by functions that may fail: from the first element on, and up to the first error. *)

val map : ('a -> ('b, 'e) result) -> 'a list -> ('b list, 'e) result
(** [map f xs] is the results of [f] for each of [xs], or its first error. *)

val map_values : ('a -> ('b, 'e) result) -> ('k * 'a) list -> (('k * 'b) list, 'e) result
(** [map_values f entries] is {!map} of the value in each entry; the keys stay. *)

val concat_map : ('a -> ('b list, 'e) result) -> 'a list -> ('b list, 'e) result
(** [concat_map f xs] is the lists of [map f xs] as one. *)

val fold : ('acc -> 'a -> ('acc, 'e) result) -> 'acc -> 'a list -> ('acc, 'e) result
(** [fold f acc [x1; ...; xn]] is [f (... (f acc x1) ...) xn], or the first error. *)
