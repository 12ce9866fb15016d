(** The parts of a fleet file that [explore] and [time] leave out. *)

val sentences : Dolphin_environment.Faults.t -> Fleet_file.t -> string list
(** [sentences faults fleet] names the vehicles that join late in [fleet], and those that leave or lose their links,
    each with the fault that would let them; none for the faults in [faults]. They have no full stop. *)

val of_assumptions : Dolphin_semantics.Core.program -> Fleet_file.t -> string list
(** [of_assumptions p fleet] names the assumptions on readings of [fleet], with their places, if [p] reads no sensor. *)

val of_time : Dolphin_environment.Faults.t -> Fleet_file.t -> string list
(** The same for [dolphin time], which knows when vehicles join, leave, and lose their links: none, unless [faults]
    has [join] and not [loss]. *)
