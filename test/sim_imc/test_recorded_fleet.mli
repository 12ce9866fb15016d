(** The simulator beside four real DUNEs that executed [examples/rendezvous.dol]. *)

val tests : unit Alcotest.test_case list
