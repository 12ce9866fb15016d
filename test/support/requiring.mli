(** Tests that require what a machine may lack. *)

val cases : ('a, string) result -> (string * ('a -> unit)) list -> unit Alcotest.test_case list
(** [cases (Ok x) cs] is the tests [cs], each given [x], which they require. [cases (Error why) cs] is empty, with
    the line ["skipped: NAME: why"] on standard output for each, which [scripts/tally] counts. *)
