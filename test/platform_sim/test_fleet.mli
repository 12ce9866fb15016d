(** Tests of {!Dolphin_platform_sim.Fleet}: what vehicles do, and what is told of it. No value of its own. *)
