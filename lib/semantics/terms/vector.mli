(** Sequences that never change, and grow at their end in constant time (amortised): a vector and the results of
    {!append} to it share their elements. Elements are found by their index in constant time. *)

type 'a t

val empty : 'a t
(** The vector without elements. *)

val of_array : 'a array -> 'a t
(** [of_array xs] has the elements of [xs], which is not to be changed from then on. *)

val to_array : 'a t -> 'a array
(** [to_array xs] is not to be changed: it is [ys] of [of_array ys]. The result of {!append} is copied. *)

val of_list : 'a list -> 'a t
(** [of_list xs] is the elements of [xs], in order. *)

val to_list : 'a t -> 'a list
(** [to_list xs] is the elements of [xs], in order. *)

val length : 'a t -> int
(** The number of elements, in constant time. *)

val get : 'a t -> int -> 'a
(** [get xs i] is the element with index [i], from [0] on. Raises [Invalid_argument] without one. *)

val append : 'a t -> 'a -> 'a t
(** [append xs x] is [xs] and [x] after it. The first such append to [xs] takes constant time (amortised); others
    copy [xs]. *)

val concat : 'a t -> 'a t -> 'a t
(** [concat xs ys] is [xs] and [ys] after it. *)

val set : 'a t -> int -> 'a -> 'a t
(** [set xs i x] is [xs] with [x] instead of [get xs i]. It is a copy. *)

val map : ('a -> 'b) -> 'a t -> 'b t
(** [map f xs] is [f x] for each element [x] of [xs], in order. *)

val for_all : ('a -> bool) -> 'a t -> bool
(** [for_all p xs] is whether [p] holds of each element. *)

val exists : ('a -> bool) -> 'a t -> bool
(** [exists p xs] is whether [p] holds of some element. *)
