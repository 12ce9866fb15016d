(** Runs through states that others stand for ({!Canonical_state}). *)

val moves : Timed_system.t -> Timed_system.arrival list -> Timed_system.move list option
(** [moves t path] is moves that lead, from the start, from each state to the next, where those of [path] lead
    through states that are alike. [None] would be an error of {!Timed_system}. *)
