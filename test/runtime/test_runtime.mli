(** Tests of {!Dolphin_runtime}. No value of its own. *)
