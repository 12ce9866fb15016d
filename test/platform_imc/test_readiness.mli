(** Whether a vehicle could be given a plan, and the reason if not. *)

val tests : string * unit Alcotest.test_case list
