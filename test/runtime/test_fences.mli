(** {!Fence_guard} and {!Fenced}, on a platform in memory. *)

val suite : unit Alcotest.test_case list
