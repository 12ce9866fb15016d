(** Maps that are written. *)

val cases : unit Alcotest.test_case list
