(** Properties of random inputs as alcotest cases: the same inputs every time, and, if [DOLPHIN_SEED] is set, others
    which that number determines. *)

val case : ?count:int -> string -> print:('a -> string) -> 'a QCheck2.Gen.t -> ('a -> bool) -> unit Alcotest.test_case
(** [case name ~print generator property] fails with a small counterexample, as [print] shows it, if [property] is false
    or raises on one of [count] (100 by default) inputs, or of [count] others of [DOLPHIN_SEED]. *)

val seeds : usual:int -> int list
(** The first seed of the random programs of a long comparison: [SEED] of the environment alone if it is set, which
    repeats a run; else [usual], and [DOLPHIN_SEED] too if that is set. *)

val on_each_seed : usual:int -> programs:int -> QCheck2.Test.t -> unit
(** [on_each_seed ~usual ~programs test] runs a test of that many programs from each of {!seeds}, which it prints first.
    Raises what [test] raises: a counterexample. *)
