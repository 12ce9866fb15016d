(** Formulas of temporal logic judged by their definitions, and random ones. *)

open Dolphin_ltl

(** A word without end: its letters, of which the last is followed by the one at place [back]. *)
type 'letter word = { letters : 'letter array; back : int }

val holds : ('letter -> 'p -> bool) -> 'letter word -> 'p Formula.t -> bool
(** [holds at w f] is whether [f] holds of [w], a proposition [p] where [at letter p]. *)

val formula : 'p QCheck2.Gen.t -> 'p Formula.t QCheck2.Gen.t
(** Of up to seven operators or so. It shrinks. *)
