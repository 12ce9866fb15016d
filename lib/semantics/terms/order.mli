(** Orders and hashes, put together from those of parts. *)

val both : int -> (unit -> int) -> int
(** [both a b] is [a], the result of a comparison, or if that is 0, [b ()]: the lexicographic order. *)

val array : ('a -> 'a -> int) -> 'a array -> 'a array -> int
(** [array compare xs ys] orders arrays, shorter ones first, those of one length by their elements. *)

val list : ('a -> 'a -> int) -> 'a list -> 'a list -> int
(** [list compare xs ys] is the lexicographic order. A tail that both share is not gone through. *)

val mix : int -> int -> int
(** [mix h h'] is the hash of a sequence of two parts with hashes [h] and [h']. *)
