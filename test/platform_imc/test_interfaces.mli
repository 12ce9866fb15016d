(** {!Dolphin_platform_imc.Interfaces}: the addresses of a machine, as Linux lists them. *)

val tests : string * unit Alcotest.test_case list
