(** Tests of {!Dolphin_semantics.Plan_builder}: every setting and every default. No value of its own. *)
