(** Formulas, their automata, and the search for runs, against an evaluator that reads the definitions aloud. *)
