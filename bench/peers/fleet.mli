(** Explores the program of the peers' models. No value of its own. *)
