(** Lists of some elements of a list, in their order. *)

val of_length : int -> 'a list -> 'a list Seq.t
(** [of_length n xs] is all lists of [n] elements of [xs], the first ones first. *)
