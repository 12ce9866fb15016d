(** Features that are empty, wrong, slightly wrong, or in another encoding or coordinate system. *)

val cases : unit Alcotest.test_case list
