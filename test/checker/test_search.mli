(** Tests of the search. No value of its own. *)
