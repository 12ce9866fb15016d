(** Tests of {!Dolphin_geo}: areas split into parts. No value of its own. *)
