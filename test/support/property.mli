(** Properties of random inputs as alcotest cases: the same inputs every time, and, where [DOLPHIN_SEED] is set, others
    which that number determines. *)

val case : ?count:int -> string -> print:('a -> string) -> 'a QCheck2.Gen.t -> ('a -> bool) -> unit Alcotest.test_case
(** [case name ~print generator property] fails with a small counterexample, as [print] shows it, if [property] is false
    or raises on one of [count] (100 by default) inputs, or of [count] others of [DOLPHIN_SEED]. *)
