(** Definitions: the built-in one against the facts, and a user's [IMC.xml]. *)

val suite : unit Alcotest.test_case list
