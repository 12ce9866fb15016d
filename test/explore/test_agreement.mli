(** Tests that the packed search and the plain one agree, on random programs. No value of its own. *)
