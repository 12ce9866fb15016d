(** The codec against packets that others made. *)

val suite : unit Alcotest.test_case list
