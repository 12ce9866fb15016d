(** Vehicles that go on though their tasks have failed, and consoles that are killed meanwhile. *)

val tests : string * unit Alcotest.test_case list
