(** How much of a vehicle's battery is left, as a function of time: for the simulator and for timed analysis. Times are
    seconds since the start. *)

type t

val start : Entry.vehicle -> t
(** At rest, at time 0, with what the scenario says is left then. *)

val set_out : t -> at:float -> t
(** [set_out b ~at] is [b] of a vehicle that is under way from [at] on. *)

val rest : t -> at:float -> t
(** Likewise, at rest. *)

val level : t -> at:float -> float
(** From 0 (empty) to 1 (full), at a time not before the last change: under way it falls by [drain] each hour; at rest
    it rises by [charge], or if that is 0 falls by a quarter of [drain]. *)

val empty_from : t -> float
(** When it is empty if all goes on as it does; [infinity] if never. *)

val is_steady : t -> at:float -> bool
(** Whether it does not change any more from [at] on. *)

val rate : Entry.vehicle -> under_way:bool -> float
(** What it gains in a second, under way or at rest: less than 0 if it falls. *)

val least : Entry.vehicle -> working:float -> until:float -> float
(** [least v ~working ~until] is what is left at the time [until] of a vehicle that was under way for [working] seconds
    before, and was never charged: below 0 by what is missing. It is less if [working] or [until] is more. *)
