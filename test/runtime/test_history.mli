(** {!Dolphin_runtime.History}: what stands when a console has died. *)

val tests : unit Alcotest.test_case list
