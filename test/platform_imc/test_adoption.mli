(** What a console takes over from one that died: see {!Dolphin_platform_imc.Execution}. *)

val tests : string * unit Alcotest.test_case list
