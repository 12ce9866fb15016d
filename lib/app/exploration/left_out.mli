(** What a fleet says of its vehicles that [explore] and [time] leave out. *)

val sentences : Dolphin_environment.Faults.t -> Fleet_file.t -> string list
(** [sentences faults fleet] names the vehicles that join late in [fleet], and those that leave or lose their links,
    each with the fault that would let them; none for what [faults] has. They have no full stop. *)

val of_links : Dolphin_environment.Faults.t -> Fleet_file.t -> string list
(** Likewise, only of those that leave or lose their links: [dolphin time] knows who joins. *)
