(** Journals compared with how long tasks may take: [dolphin trace check --timed]. *)

val check : Program_file.t -> Fleet_file.t -> string -> (string list, Error.t) result
(** [check program fleet path] is a sentence for each task and timer of the run in the journal [path], which is a run of
    [program], that ended outside of the bounds that [fleet] gives. *)
