(** How long {!Dolphin_assignment.Assignment} takes on large problems: one line each. No value of its own. *)
