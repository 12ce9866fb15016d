(** Tests of the ways that plans take, in {!Dolphin_semantics.Plan}. No value of its own. *)
