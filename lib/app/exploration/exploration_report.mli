(** The result of an exploration, for people and for programs. *)

module Search := Dolphin_explore.Search

val print : ?from:Present.t -> strict:bool -> Program_file.t -> Search.outcome -> unit
(** [print ~from ~strict program o] prints [o] on standard output: the present [from] that was explored from, a verdict
    for each property, the counts, and a counterexample of each violation, in columns. Unless [strict], remarks
    ({!Exploration.is_remark}) are notes. *)

val print_violations : strict:bool -> Program_file.t -> Search.outcome -> unit
(** The counterexamples alone, each after a blank line. *)

val to_json : ?from:Present.t -> Program_file.t -> Search.outcome -> Yojson.Safe.t
(** [to_json ~from program o] is [o] as one object. *)
