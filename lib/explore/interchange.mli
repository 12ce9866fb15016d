(** What can change places in a task that is about to be executed: an automorphism is looked for between each two
    things that
    stand side by side and are alike, and is used only once it has been checked on the whole task and on N. *)

open Dolphin_semantics

(** Things that can change places in any way, each known by the pairs of N that are its own. *)
type ring = int array array  (** by thing: its pairs, by {!Pattern.pair}, in an order that is the same for all; disjoint *)

type t = {
  rings : ring list;  (** disjoint *)
  labels : (Alike.label * Alike.label) list;  (** what becomes what under some checked automorphism *)
}

val find : Alike.context -> Residual.t -> Tuples.t -> t option
(** [find c r n] is for [r] with [n] in N; [None] if nothing can change places. *)

val renamed : Pattern.context -> (int -> int) -> Tuples.t -> Tuples.t
(** [renamed c f n] is [n] with each pair that is known to [c] renamed by [f], which keeps keys. *)
