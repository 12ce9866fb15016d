(** Maps in each format. *)

val cases : unit Alcotest.test_case list
