(** Our codec and imcpy's understand each other. *)

val suite : unit Alcotest.test_case list
