(** How long {!Dolphin_semantics.Assignment} takes on large problems: one line each. No value of its own. *)
