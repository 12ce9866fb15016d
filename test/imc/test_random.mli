(** The codec against random messages, built from the facts alone: layouts, both byte orders and the
    JSON form. *)

val suite : unit Alcotest.test_case list
