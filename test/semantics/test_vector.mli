(** Tests of vectors: as lists are, whatever is appended to what, and what appending costs in programs. No value of its
    own. *)
