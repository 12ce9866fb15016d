(** Several consoles, as pure stations with a network between them: who commands a vehicle. *)

val tests : string * unit Alcotest.test_case list
