(** Tests of {!Dolphin_numerals}. No value of its own. *)
