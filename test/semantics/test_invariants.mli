(** Tests of what every transition keeps, along random walks through random programs. No value of its own. *)
