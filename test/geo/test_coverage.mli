(** Tests of {!Dolphin_geo}: ways that cover areas. No value of its own. *)
