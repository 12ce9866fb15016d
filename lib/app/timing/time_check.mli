(** Journals compared with how long tasks may take: [dolphin trace check --timed]. *)

val check : ?tolerance:int -> Program_file.t -> Fleet_file.t -> string -> (string list, Error.t) result
(** [check ~tolerance program fleet path] is a sentence for each task and timer of the run in the journal [path], which
    is a run of [program], that ended outside of the bounds that [fleet] gives, by more than [tolerance] milliseconds:
    by default 0 in virtual time, and 1,000 in a run that was real, or was resumed. *)
