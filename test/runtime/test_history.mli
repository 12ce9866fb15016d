(** {!Dolphin_runtime.History}: the state when a console has died. *)

val tests : unit Alcotest.test_case list
