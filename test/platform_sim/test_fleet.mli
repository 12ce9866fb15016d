(** Tests of {!Dolphin_platform_sim.Fleet}: the behaviour of vehicles, and their reports. No value of its own. *)
