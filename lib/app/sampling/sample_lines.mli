(** Simulated runs as lines of JSON, so that runs that one machine made are counted on another. docs/time.md has their
    members. *)

val header : version:string -> answers:string list -> Program_file.t -> Fleet_file.t -> string
(** [header ~version ~answers program fleet] is the line before those of runs: the version of Dolphin, and digests of
    the inputs of the runs. Lines whose headers are equal belong together. *)

val of_sample : Program_file.t -> seed:int -> Sampled_run.t -> string
(** The line of one run. It gives the run back, to the last digit of its time. *)

val read : header:string -> string -> add:(seed:int -> Sampled_run.t -> unit) -> (unit, Error.t) result
(** [read ~header path ~add] gives [add] all runs of the file [path], of standard input if it is ["-"], in their order.
    Headers may stand anywhere, the first one before all runs, so that outputs can be put behind each other.

    [Error] names the line that is not a run or has another header, or whose seed does not follow that of the run
    before: if runs were missing, those that take long for example, shares would be wrong. *)
