(** Times that were measured, in seconds from 0 on, in ascending order. *)

type t

val of_list : float list -> t
(** [of_list times] is [times], in any order. *)

val is_empty : t -> bool
(** Whether there are none. *)

val size : t -> int
(** The number of times. *)

val quantile : float -> t -> float
(** [quantile q d] is the least time of [d] such that a share [q] of [d] or more is not greater: of 100 times, the 5th
    for [q = 0.05]. [d] is not empty; [quantile 0. d] is its least time. *)

(** The number of times from [from] on, before [until], in seconds. *)
type bin = { from : float; until : float; count : int }

val bins : most:int -> t -> bin list
(** [bins ~most d] is the number of elements of [d] in each of at most [most] spans, [most >= 2]: consecutive,
    without a gap, all of one width, which is 1, 2, 5, 10, 15 or 30 seconds, minutes or hours (or 12, 24 hours and
    multiples of them), or such numbers of milliseconds. A time at the edge of two is in the later one. The first and
    the last span are not empty. *)
