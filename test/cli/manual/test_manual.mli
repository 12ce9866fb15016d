(** Runs the examples of docs/language.md. *)
