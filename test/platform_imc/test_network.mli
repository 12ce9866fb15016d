(** The whole platform, over sockets of 127.0.0.1: discovery, programs, a bad network, the end. *)

val tests : unit Alcotest.test
