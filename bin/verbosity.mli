(** [-v] and [--verbosity], for commands that run something.

    This is not [Logs_cli.level]: its [--quiet] would say nothing of the log of a run, which is what people expect to
    silence. *)

val setup : unit Cmdliner.Term.t
(** Sets the level of all sources, and has what they tell written on standard error, a line each: source, level, text.
    By default there is only what is an error or a warning. *)
