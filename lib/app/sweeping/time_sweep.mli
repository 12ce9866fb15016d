(** [dolphin time] for several values of a parameter. *)

module Timed_analysis = Dolphin_time.Timed_analysis

val verdict : ?deadline:int -> Timed_analysis.outcome -> Sweep.verdict
(** Whether nothing is {!Timed_analysis.shortfall}. *)

val shortfall : Timed_analysis.shortfall -> string
(** In a word or two. *)

val print : ?deadline:int -> Sweep.t -> Timed_analysis.outcome Sweep.row list -> unit
(** The table; a run that breaks what is asked with the value below the fewest, and a run that ends last with the
    fewest. If none holds, a run that breaks it with the last value. *)

val to_json : ?deadline:int -> Sweep.t -> Timed_analysis.outcome Sweep.row list -> Yojson.Safe.t
(** The answers for programs, an object for each value. *)
