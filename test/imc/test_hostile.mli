(** The codec against bytes that are no packet. *)

val suite : unit Alcotest.test_case list
