(** Is every rule used? By TLC's own option [-coverage], which counts how often each action was taken: the specification
    has one for each rule. *)

open Dolphin_semantics

type counted = {
  rule : Rule.t;
  taken : int;  (** how often TLC took its action *)
  derivations : int;  (** in how many transitions that TLC printed it was used *)
}

val count :
  Dolphin_tlc.Installation.t -> Batch.prepared list -> (counted list * Batch.t, string) result
(** [count i ps] is the counts for all of [ps] together, in one run of TLC. *)

val miscounted : counted list -> counted list
(** Those of which the two counts are not the same. *)

val missing : counted list -> Rule.t list
(** Those that were not taken. *)
