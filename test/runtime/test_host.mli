(** {!Dolphin_runtime.Host} with small shell scripts for hosts, and values as JSON. *)

val tests : unit Alcotest.test_case list
