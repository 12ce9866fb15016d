(** Tests of {!Dolphin_scenario}. Texts of fleets are beside them: [good/X.fleet] is read as the scenario that
    [good/X.expected] shows, [bad/X.fleet] is refused with the words of [bad/X.expected]. The program prints what it
    finds for one fleet if it is given its name. No value of its own. *)
