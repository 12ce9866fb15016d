(** The simulated vehicle against a recording of a real one (DUNE 2026.01): the console's packets of the recording, at
    their times, must be answered alike. *)

val tests : unit Alcotest.test_case list
