(** The course of one vehicle's battery in runs with time: when it falls and when it rises, and the bounds that the
    program's looks at it imply. docs/time.md has the reasons. *)

open Dolphin_semantics

type t

val create : Clocked.options -> Core.vehicle -> t
(** [create o v] is the course of [v] in the runs of [o]. *)

val vehicle : t -> Core.vehicle
(** The vehicle of {!create}. *)

val may_do : t -> Clocked.state -> Dolphin_scenario.Battery.doing list
(** {!Clocked.may_do} of its vehicle: it works or charges from the start of a task until its end, whichever it is. *)

val turns : t -> Clocked.state -> Clocked.step -> bool
(** [turns c s step] is whether the battery may fall or rise otherwise from [step] of [s] on, or [step] depends on
    its reading. *)

(** {1:looks Bounds from looks} *)

(** From 0 to 1: no less and no more is in the battery when it is looked at. *)
type range = { above : float; below : float }

val anything : range
(** From 0 to 1: any reading. *)

val seen : t -> Clocked.state -> Clocked.step -> range
(** [seen c s step] is the readings of the battery with which [step] is possible from [s]. *)

val waited : t -> Clocked.state -> float
(** [waited c s] is its least reading as long as time passes in [s], because some guard does not hold: 0 without a
    look. *)

val is_heard : t -> bool
(** [is_heard c] is whether its reading is its charge: not where its link may be lost. *)

val is_newly_bound : t -> Clocked.step -> bool
(** [is_newly_bound c step] is whether it is bound or released with [step]. *)
