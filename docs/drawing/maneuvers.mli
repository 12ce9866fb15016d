(** The drawings of maneuvers in docs/language.md: [maneuvers.exe rows RECORDED] and [maneuvers.exe others] print
    one. The ways are those of {!Dolphin_plans.Plan.path}, which simulated vehicles go; [RECORDED] has positions
    of real vehicles. *)
