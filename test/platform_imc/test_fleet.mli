(** Four real DUNEs that execute [examples/rendezvous.dol]: fed with their datagrams, a console comes to the same
    requests and ends as the one that was recorded. *)

val tests : string * unit Alcotest.test_case list
