(** How much of a vehicle's battery is left, as a function of time: for the simulator and for timed analysis. Times are
    seconds since the start. *)

type t

(** The activity of a vehicle, as far as its battery is concerned. *)
type doing =
  | Rests  (** where it charges, if it does *)
  | Away  (** it rests away from its chargers *)
  | Works  (** it runs a plan that drains *)
  | Charges of float  (** it runs a plan with [charges]: an hour of it gives this share *)

val start : Entry.vehicle -> t
(** At rest at its place, at time 0, with the scenario's charge. *)

val resting_at : Entry.vehicle -> Dolphin_geo.Position.t -> doing
(** [resting_at v p] is [Rests], or [Away] if [v] has chargers and [p] is beyond each of them. *)

val turn : t -> at:float -> doing -> t
(** [turn b ~at doing] is [b] of a vehicle that does this from [at] on. *)

val level : t -> at:float -> float
(** From 0 (empty) to 1 (full), at a time not before the last change: work lowers it by [drain] each hour; rest
    raises it by [charge], or if that is 0, or away from its chargers, lowers it by a quarter of [drain]; a plan that
    charges raises it. *)

val empty_from : t -> float
(** When it is empty if all goes on as it does; [infinity] if never. *)

val is_steady : t -> at:float -> bool
(** Whether it does not change any more from [at] on. *)

val rate : Entry.vehicle -> doing -> float
(** Its gain in a second: less than 0 if it falls. *)

val least : Entry.vehicle -> working:float -> until:float -> float
(** [least v ~working ~until] is the charge at the time [until] of a vehicle that was under way for [working] seconds
    before, and was never charged: below 0 by the missing charge. It is less if [working] or [until] is more. *)
