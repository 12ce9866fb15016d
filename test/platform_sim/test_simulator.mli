(** Tests of {!Dolphin_platform_sim.Simulator}: the fleet as a platform, in virtual and in real time. No value of its
    own. *)
