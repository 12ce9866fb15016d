(** Positions of vehicles that may be picked: they are current. *)

val tests : string * unit Alcotest.test_case list
