(** Tests of {!Dolphin_geo}: searches. No value of its own. *)
