(** [dolphin explore] for several values of a parameter. *)

module Search := Dolphin_explore.Search

val print : strict:bool -> Sweep.t -> Search.outcome Sweep.row list -> unit
(** The table, and the fault of the value below the fewest; if none holds, of the last value. *)

val to_json : Sweep.t -> Search.outcome Sweep.row list -> Yojson.Safe.t
(** The answers for programs, an object for each value. *)
