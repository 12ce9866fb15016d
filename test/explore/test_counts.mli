(** Tests of numbers of states and transitions that are counted by hand. No value of its own. *)
