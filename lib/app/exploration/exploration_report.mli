(** The result of an exploration, for people and for programs. *)

module Search := Dolphin_explore.Search

val print : strict:bool -> Program_file.t -> Search.outcome -> unit
(** [print ~strict program o] prints [o] on standard output: a verdict for each property, the counts, and a
    counterexample of each violation, in columns. Unless [strict], remarks ({!Exploration.is_remark}) are notes. *)

val print_violations : strict:bool -> Program_file.t -> Search.outcome -> unit
(** The counterexamples alone, each after a blank line. *)

val to_json : Program_file.t -> Search.outcome -> Yojson.Safe.t
(** [to_json program o] is [o] as one object. *)

val mebibytes : int -> int
(** [mebibytes bytes] is [bytes] in MiB, rounded down. *)
