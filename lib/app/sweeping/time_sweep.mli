(** [dolphin time] for several values of a parameter. *)

module Timing = Dolphin_time.Timing

val verdict : ?deadline:int -> Timing.outcome -> Sweep.verdict
(** Whether nothing is {!Timing.shortfall}. *)

val shortfall : Timing.shortfall -> string
(** In a word or two. *)

val print : ?deadline:int -> Sweep.t -> Timing.outcome Sweep.row list -> unit
(** The table; a run that breaks what is asked with the value below the fewest, and a run that ends last with the
    fewest. If none holds, a run that breaks it with the last value. *)

val to_json : ?deadline:int -> Sweep.t -> Timing.outcome Sweep.row list -> Yojson.Safe.t
