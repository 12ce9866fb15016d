(** Tests of {!Dolphin_platform_sim.Track}. No value of its own. *)
