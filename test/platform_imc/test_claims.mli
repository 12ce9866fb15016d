(** Whom a vehicle belongs to while it is ready: it was busy a moment ago, or another console holds it. *)

val tests : string * unit Alcotest.test_case list
