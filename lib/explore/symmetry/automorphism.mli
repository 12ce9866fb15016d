(** What can change places in a task that is about to be executed: an automorphism is looked for between each two
    things that
    stand side by side and are alike, and is used only once it has been checked on the whole task and on N. *)

open Dolphin_semantics

(** Things that can change places in any way, each known by the pairs of N that are its own. *)
type ring = int array array  (** by thing: its pairs, by {!Skeleton.pair}, in an order that is the same for all; disjoint *)

type t = {
  rings : ring list;  (** disjoint *)
  labels : (Task_isomorphism.label * Task_isomorphism.label) list;  (** what becomes what under some checked automorphism *)
}

val find : Task_isomorphism.context -> Residual.t -> Tuples.t -> t option
(** [find c r n] is for [r] with [n] in N; [None] if nothing can change places. *)

val renamed : Skeleton.context -> (int -> int) -> Tuples.t -> Tuples.t
(** [renamed c f n] is [n] with each pair that is known to [c] renamed by [f], which keeps keys. *)
