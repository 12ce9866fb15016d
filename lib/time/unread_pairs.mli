(** Pairs of N that no code reads. A state goes on in the same way without them, so states that differ in such pairs
    alone become one. *)

val keys : Dolphin_semantics.Core.program -> string list
(** [keys p] is the keys of pairs that code of [p], ends of its tasks or the outside post, and that no code consumes,
    polls or counts. There is none if code reads pairs of a key that it computes. *)
