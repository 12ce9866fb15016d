(** Programs with times: TLC, by [Timed.tla], and [dolphin time] find the same earliest and latest dates of the same
    moments: how runs end, and when tasks start, end, fail and are stopped. *)

type t = { case : Case.t; durations : Dolphin_time.Durations.t; plans : string list }

val random : seed:int -> int -> t list
(** [random ~seed n] is [n] programs of {!Case.random}, with durations of some seconds. *)

val examples : string -> t list
(** [examples directory] is the programs there with the durations of their fleets, and with one failure. *)

val small : t list
(** Small programs, each about one thing that is timed. *)

type prepared

val prepare : ticks:int -> states:int -> t list -> prepared list
(** Those of the programs that TLC can be given, with the results of [dolphin time]: that are over within the limit
    of ticks, and of states. *)

val programs :
  Dolphin_tlc.Installation.t -> (string * string) list -> prepared list -> (unit, string) result
(** [programs i specification ps] is whether TLC finds the same of all of [ps], in one run; or the first difference. *)

val report : Dolphin_tlc.Installation.t -> batch:int -> prepared list -> Comparison.count
(** Compares them, and prints how many agree. *)
