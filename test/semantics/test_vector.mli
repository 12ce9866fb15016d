(** Tests of vectors: as lists are, after any appends, and the cost of appending in programs. No value of its own. *)
