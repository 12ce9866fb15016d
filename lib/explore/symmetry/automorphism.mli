(** Automorphisms of a task that is about to be executed. A candidate exchanges two isomorphic subtasks that stand side
    by side; it is used only once it has been checked on the whole task and on N. *)

open Dolphin_semantics

type exchange
(** A renaming of pairs of N, its own inverse. *)

(** An orbit of blocks: by block, its pairs ({!Skeleton.pair}), in an order that is the same for all blocks. The pairs
    of an orbit are distinct. Any permutation of its blocks is an automorphism. *)
type orbit = int array array

type t = {
  orbits : orbit list;  (** disjoint *)
  labels : (Task_isomorphism.label * Task_isomorphism.label) list;
  (** each with its image under some verified automorphism, where they differ *)
  exchanges : exchange list;  (** all that were checked *)
}

val find : tick:(unit -> unit) -> Task_isomorphism.context -> Residual.t -> Tuples.t list -> t option
(** [find ~tick c r ns] is the automorphisms of [r] that fix each of [ns]; [None] if only the identity does. [tick]
    is called before each candidate is checked. *)

val fixes : Skeleton.context -> t -> Tuples.t -> bool
(** [fixes c a n] is whether each of [a.exchanges] leaves [n] as it is. *)

val renamed : Skeleton.context -> (int -> int) -> Tuples.t -> Tuples.t
(** [renamed c f n] is [n] with each of its pairs renamed by [f], which keeps keys. *)
