(** Tests of the set of packed states. No value of its own. *)
