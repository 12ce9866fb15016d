(** Tests of {!Dolphin_semantics.Plan_builder}: every fault, its text and its place. No value of its own. *)
