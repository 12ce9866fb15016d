(** [-v] and [--verbosity], for commands that run something.

    This is not [Logs_cli.level]: its [--quiet] would not concern the log of a run, which people expect to silence. *)

val setup : unit Cmdliner.Term.t
(** Sets the level of all sources, and writes their messages to standard error, a line each: source, level, text. By
    default there is only what is an error or a warning. *)
