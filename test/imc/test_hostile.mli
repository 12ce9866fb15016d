(** The codec against bytes that are not a packet. *)

val suite : unit Alcotest.test_case list
