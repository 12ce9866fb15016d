(** The result of an exploration as JUnit's XML: a test case for each property, for collectors of test results. *)

val write : strict:bool -> Program_file.t -> string -> Dolphin_explore.Search.outcome -> (unit, Error.t) result
(** [write ~strict program path o] writes [o] into the file [path]. A violated property is a failure, with the run that
    shows it; one that is inconclusive is an error; a remark ({!Exploration.is_remark}) that is violated is output of a
    case that passes, unless [strict]. *)
