(** Is every rule used? By TLC's own option [-coverage], which counts how often each action was taken: the specification
    has one for each rule. *)

open Dolphin_semantics

val excused : Rule.t list
(** Rules that no example can use in the worlds of [Case.examples] and [Case.faulty_examples]. *)

type counted = {
  rule : Rule.t;
  taken : int;  (** how often TLC took its action *)
  derivations : int;  (** in how many transitions that TLC printed it was used *)
}

val count :
  Dolphin_tlc.Installation.t -> Batch.prepared list -> (counted list * Batch.t, string) result
(** [count i ps] is the counts for all of [ps] together, in one run of TLC. *)

val miscounted : counted list -> counted list
(** Those of which TLC took fewer transitions than it printed, or some where it printed none. It may take more: those with
    one label between two states are printed as one. *)

val missing : counted list -> Rule.t list
(** Those that were not taken, and are not {!excused}. *)

val no_longer_excused : counted list -> Rule.t list
(** The {!excused} ones that were taken. *)
