(** Tests that checking a constant plan and building it agree. No value of its own. *)
