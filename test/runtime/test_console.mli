(** {!Dolphin_runtime.Console}, and the lines it reads. *)

val tests : unit Alcotest.test_case list
