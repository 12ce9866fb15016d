(** More systems than a console remembers, and systems that share an IMC address or a name. *)

val tests : string * unit Alcotest.test_case list
