(** The plans of a program and of its fleet, before anything runs. *)

val list : Hall.t -> Dolphin_json.Field.members -> (Exchange.json, Exchange.refusal) result Lwt.t
(** What [POST plans] asks for: what [dolphin plan --json] tells of the program, in a process of its own, and the names
    of the plans that each vehicle of the fleet knows. One such process runs at a time, for {!longest} at most. *)

val longest : float
(** 20 seconds. *)
