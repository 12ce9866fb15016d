(** Tests of {!Dolphin_semantics.Tuple_space}: examples, and a list as its model. No value of its own. *)
