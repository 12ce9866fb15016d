(** Who hears a simulated vehicle, and how often. *)

val tests : unit Alcotest.test_case list
