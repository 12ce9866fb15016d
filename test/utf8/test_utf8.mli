(** Tests of {!Dolphin_utf8}. No value of its own. *)
