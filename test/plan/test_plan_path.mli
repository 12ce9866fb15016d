(** Tests of the ways that plans take, in {!Dolphin_plans.Plan}. No value of its own. *)
