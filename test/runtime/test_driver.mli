(** {!Dolphin_runtime.Driver} on the mock platform. *)

val tests : unit Alcotest.test_case list
