(** Runs that are followed without their inert ends ({!Inert}), with these ends. *)

val run : Timed_system.t -> Timed_system.goal -> Timed_system.arrival list -> Clocked.step list option
(** [run t goal path] is the steps of a run along [path], from the start, in which all is as late, or as early, as
    can be. [None] would be an error of {!Timed_system}. *)
