(** What is to happen, in order of time. *)

type key
(** Of one occurrence in an agenda. *)

type 'a t

val empty : 'a t
(** Nothing is to happen. *)

val add : float -> 'a -> 'a t -> key * 'a t
(** [add time x a] is [a] with [x] at [time], after all that [a] has had at that time. O(log n), like the others. *)

val remove : key -> 'a t -> 'a t
(** [remove k a] is [a] without the occurrence [k], if it is still there. *)

val first : 'a t -> (float * 'a) option
(** [first a] is the earliest occurrence, of those at the same time the one that was added first. *)

val rest : 'a t -> 'a t
(** [rest a] is [a] without [first a]. *)
