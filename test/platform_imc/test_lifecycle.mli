(** The recorded life of a real vehicle, replayed to the console's pure state: each section has its verdict. *)

val tests : unit Alcotest.test
