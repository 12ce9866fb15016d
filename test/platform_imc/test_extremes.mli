(** One datagram with an extreme number, in each field of each message, does not change how and when a plan ends. *)

val tests : string * unit Alcotest.test_case list
