(** Tests of invariants of every transition, along random walks through random programs. No value of its own. *)
