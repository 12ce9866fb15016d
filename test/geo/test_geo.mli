(** Tests of {!Dolphin_geo}: known values, and laws on random positions. No value of its own. *)
