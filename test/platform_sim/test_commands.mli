(** Laws of {!Dolphin_platform_sim.Fleet} under random commands: a platform's promises to its driver. No value of its
    own. *)
