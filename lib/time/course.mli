(** The course of one vehicle's battery in runs with time: when it falls and when it rises, and what the program's looks
    at it say of it. docs/time.md has the reasons. *)

open Dolphin_semantics

type t

val create : Timed.options -> Core.vehicle -> t
val vehicle : t -> Core.vehicle

val may_do : t -> Timed.state -> Dolphin_scenario.Battery.doing list
(** {!Timed.may_do} of its vehicle: it works or charges from the start of a task until its end, whichever it is. *)

val turns : t -> Timed.state -> Timed.step -> bool
(** [turns c s step] is whether the battery may fall or rise otherwise from [step] of [s] on, or [step] depends on what
    it shows. *)

(** {1:looks What looks say} *)

(** From 0 to 1: no less and no more is in the battery when it is looked at. *)
type range = { above : float; below : float }

val anything : range

val seen : t -> Timed.state -> Timed.step -> range
(** [seen c s step] is what the battery shows if [step] is taken from [s], whatever else does. *)

val waited : t -> Timed.state -> float
(** [waited c s] is what it shows at the least as long as time passes in [s], because some guard does not hold: 0 if
    nobody looks. *)

val is_heard : t -> bool
(** [is_heard c] is whether what it shows says how full it is: not where its link may be lost. *)

val is_newly_bound : t -> Timed.step -> bool
(** [is_newly_bound c step] is whether it is bound or released with [step]. *)
