(** The execution of plans against a scripted vehicle over a bad network: nothing is reported that did not happen, all
    is reported that did, nothing runs twice without a word, nothing runs on that was stopped. *)

val tests : unit Alcotest.test
