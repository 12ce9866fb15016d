(** Tests of {!Dolphin_assignment.Assignment}: examples, and all allocations of small problems. No value of its own. *)
