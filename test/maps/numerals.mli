(** Numbers by the grammar of each format. *)

val cases : unit Alcotest.test_case list
