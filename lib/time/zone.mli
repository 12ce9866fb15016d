(** Sets of clock values: conjunctions of bounds on clocks and on their differences, in whole milliseconds (difference
    bound matrices). Clock 0 is the time since the start of the run, the {e date}; others are numbered from 1. All
    bounds include their ends. A zone is never empty and always closed: each bound is as tight as the others make it. *)

type t

val start : t
(** Only the date, which is 0. *)

val clocks : t -> int
(** How many clocks it has, the date included. *)

val contains : t -> int array -> bool
(** [contains z xs] is whether [z] has the valuation in which clock [i] is [xs.(i)]. *)

val subset : t -> t -> bool
(** [subset z z'] is whether each valuation of [z] is in [z'], which has as many clocks. *)

val ranks : t -> int array
(** [ranks z] is for clock [i + 1] of [z], at place [i], its rank by age: a clock that is nowhere in [z] less than
    another one has a higher rank. Ranks follow from the bounds alone: they do not depend on the order of the clocks
    from 1 on. Clocks with equal bounds have one rank. *)

val are_equal : int -> int -> t -> bool
(** [are_equal i j z] is whether clocks [i] and [j] are equal in all of [z]. *)

val equal : t -> t -> bool
(** Whether they have the same valuations. *)

val delayed : t -> t -> int
(** [delayed z z'] is the most milliseconds by which all dates of [z] may be put off such that it is a {!subset} of
    [z'], which has as many clocks: negative without such a number, and [max_int] without a greatest one. *)

val earliest_date : t -> int
(** Of a zone that does not reach down. *)

val latest_date : t -> int option
(** [None]: no bound. *)

val most : int -> t -> int option
(** [most i z] is the greatest value of clock [i] in [z]; [None]: no bound. *)

val least : int -> t -> int
(** [least i z] is the least value of clock [i] in [z], which is 0 or more in all of it. *)

(** {1:operations Operations}

    Each as a set of valuations; [None] is the empty one. *)

val delay : t -> t
(** [delay z] is [z] after the passing of any time. *)

val at_least : int -> int -> t -> t option
(** [at_least i n z] is those of [z] with clock [i] at [n] or more. *)

val at_most : int -> int -> t -> t option
(** [at_most i n z] is those of [z] with clock [i] at [n] or less; [None] if there are none. *)

val rearranged : int option array -> t -> t
(** [rearranged from z] has clock 0 of [z], and as clock [k + 1] clock [i] of [z] if [from.(k)] is [Some i], or a new
    one at 0. *)

val freed : int -> t -> t
(** [freed i z] is [z] with each valuation for any other value of clock [i] too, be it negative. *)

val reaching_down : t -> t
(** [reaching_down z] is [z] with each valuation for any earlier date too. *)

val at_any_date : t -> t
(** [at_any_date z] is [z] with each valuation for any other date. *)

val reaching_up : t -> t
(** [reaching_up z] is [z] with each valuation for any later date too. *)
