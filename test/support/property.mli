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

(** {1 Counts}

    A law holds for every input. A demand such as "most are exact" depends on the seed: it is asked of the inputs of the
    usual seed, and no new seed makes it fail. *)

val is_usual : unit -> bool
(** [is_usual ()] is whether the input that a property gets now is one of the usual seed, or of [SEED] if that is set.
    It is true outside of properties. *)

val count : int ref -> unit
(** [count n] increments [n] if {!is_usual}. Counts that a test compares with others, or with the number of inputs, grow
    by it. *)
