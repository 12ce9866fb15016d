(** Vectors of small integers, 4 bytes each, outside of the reach of the garbage collector. *)

type t
(** A vector of integers from 0 to {!limit}. *)

val limit : int
(** 2³¹ - 1. *)

val make : int -> t
(** [make n] has [n] elements, all 0. *)

val length : t -> int
(** The number of elements. *)

val get : t -> int -> int
(** [get v i] is the element [i], from 0.
    @raise Invalid_argument if it has none. *)

val set : t -> int -> int -> unit
(** [set v i x] makes [x], from 0 to {!limit}, the element [i]. @raise Invalid_argument if [v] has no such element. *)

val order_by : (int -> int) -> keys:int -> t -> t
(** [order_by key ~keys v] is [v] in ascending order of [key], a number from 0 to [keys - 1]; elements with the same
    key stay in order. It takes time and room for [length v + keys]. *)

(** Vectors that grow at their end. *)
module Growing : sig
  type vector := t
  type t

  val create : unit -> t
  (** No elements. *)

  val length : t -> int
  (** The number of elements so far. *)

  val add : t -> int -> unit
  (** Puts an element at the end. *)

  val contents : t -> vector
  (** The elements so far. They may be shared with the growing vector: add nothing afterwards. *)
end
