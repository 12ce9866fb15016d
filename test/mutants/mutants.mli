(** Makes mistakes in lib/, one at a time, in a copy of the tree, and reports whether the tests notice them. *)
