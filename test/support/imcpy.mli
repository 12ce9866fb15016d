(** imcpy, an implementation of IMC in Python and C++ that is independent of ours, as a second opinion.

    The variable [DOLPHIN_IMCPY] names the Python that has it; [scripts/imcpy] sets one up and prints its name, and
    [scripts/test] does both. *)

val cases : (string * (python:string -> unit)) list -> unit Alcotest.test_case list
(** [cases cs] is the tests [cs]. Without imcpy they are empty, and a line on standard output for each reports that
    it is skipped. *)
