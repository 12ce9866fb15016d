(** Checksums, headers, sets of values, tuples, JSON. *)

val suite : unit Alcotest.test_case list
