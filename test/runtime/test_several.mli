(** {!Dolphin_runtime.Several}: two platforms as one. *)

val tests : unit Alcotest.test_case list
