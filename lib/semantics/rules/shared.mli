(** The shared part of a configuration: S = <store, A, B, N>. The rules of tasks take one and give one; the control
    is not part of it. *)

open Core

type t = {
  store : Store.t;  (** the values of global variables *)
  allocation : platform_task Vehicle_map.t;  (** A: the task that each vehicle runs; the others of B run none *)
  bound : vehicle list;  (** B, in pick order *)
  tuples : Tuples.t;  (** N *)
}

val initial : program -> t
(** [initial p] is that of a run of [p] that begins: empty. *)

val post : string -> value -> t -> t
(** [post k x s] is [s] with one pair [k:x] more in N. *)

val ensure : ensured list -> t -> t
(** [ensure ds s] is [s] after the end of a task has done [ds]. *)

val without_keys : string list -> t -> t
(** [without_keys ks s] is [s] without the pairs of N with one of these keys. *)

val without_fresh : t -> t
(** [without_fresh s] is [s] without the pairs of N with a key of some [fresh]: that of no task that is left. *)

val compare : t -> t -> int
(** A total order, of which {!equal} is the equality. *)

val equal : t -> t -> bool
(** [equal s s'] is [compare s s' = 0]. *)

val hash : t -> int
(** Equal shared parts have equal hashes. *)

val pp : program -> Format.formatter -> t -> unit
(** In a canonical text: equal shared parts print alike. *)
