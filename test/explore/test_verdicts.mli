(** Tests of verdicts and bounds, on small programs. No value of its own. *)
