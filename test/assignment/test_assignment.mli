(** Tests of {!Dolphin_semantics.Assignment}: examples, and all allocations of small problems. No value of its own. *)
