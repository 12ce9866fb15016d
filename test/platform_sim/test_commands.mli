(** Laws of {!Dolphin_platform_sim.Fleet} under random commands: what a platform promises its driver. No value of its
    own. *)
