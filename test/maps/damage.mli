(** Archives, and files of each format that are cut or changed anywhere. *)

val cases : unit Alcotest.test_case list
