(** The result of an exploration in the Static Analysis Results Interchange Format (SARIF 2.1.0, OASIS), which code
    hosts and editors show beside the lines of a program. *)

val json : strict:bool -> version:string -> Program_file.t -> Dolphin_explore.Search.outcome -> Yojson.Safe.t
(** [json ~strict ~version program o] is a log of one run of this [version] of dolphin, with a result for each property:
    its kind is [pass], [open] (inconclusive) or [fail], and then its level [error], or [note] for remarks
    ({!Exploration.is_remark}) unless [strict]. The run that shows a violation is its code flow. *)

val write :
  strict:bool -> version:string -> Program_file.t -> string -> Dolphin_explore.Search.outcome -> (unit, Error.t) result
(** [write ~strict ~version program path o] writes {!json} into the file [path]. *)
