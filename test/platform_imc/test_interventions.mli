(** What another console does to a plan of ours, in the reason why it failed. *)

val tests : string * unit Alcotest.test_case list
