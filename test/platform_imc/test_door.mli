(** Texts of datagrams that are not UTF-8, or have control characters. *)

val tests : string * unit Alcotest.test_case list
