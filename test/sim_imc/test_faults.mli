(** Bad links, hostile packets, and requests in any order. *)

val tests : unit Alcotest.test_case list
