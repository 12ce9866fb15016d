(** The queue of a discrete-event simulation: the future events, in order of time. *)

type key
(** Identifies one event of a queue. *)

type 'a t

val empty : 'a t
(** Nothing is to happen. *)

val add : float -> 'a -> 'a t -> key * 'a t
(** [add time x q] is [q] with [x] at [time] (s), after all that [q] has had at that time. O(log n), like the others. *)

val remove : key -> 'a t -> 'a t
(** [remove k q] is [q] without the event [k], if it is still there. *)

val first : 'a t -> (float * 'a) option
(** [first q] is the earliest event with its time; of those at the same time the one that was added first. *)

val rest : 'a t -> 'a t
(** [rest q] is [q] without [first q]. *)
