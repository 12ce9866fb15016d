(** Two consoles command one vehicle at once: each plan that runs after both have closed was said to. *)

val tests : string * unit Alcotest.test_case list
