(** Tests of {!Dolphin_maps}. No value of its own. *)
