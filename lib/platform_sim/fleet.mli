(** The simulated fleet itself: a pure state machine. Time passes only by a call; this module neither sleeps nor draws
    from a hidden source nor waits. {!Simulator} is the shell that makes a platform of it.

    A fleet is a set of vehicles and an {!Event_queue} of their future events. {!step} takes the next event; the
    commands of a platform change the vehicles and the queue. Everything costs O(log n) but {!vehicles}, {!quiet},
    telemetry (each second, O(n) in the vehicles that are bound) and a change of the timeout of all. *)

open Dolphin_semantics
open Dolphin_runtime

type t

val create : seed:int -> Dolphin_scenario.Scenario.t -> t
(** [create ~seed s] is the fleet of [s] at time 0. Fleets of one seed and scenario that are commanded alike behave
    alike. *)

(** {1:time Time} *)

val now : t -> float
(** Seconds since the start. *)

val due : t -> float option
(** When something happens next: not before [now]. [None]: nothing will, unless the fleet is commanded. *)

val advance : t -> float -> t
(** [advance f time] is [f] at [time], but not later than [due f], and not earlier than [now f]. *)

val step : t -> (Platform.event option * t) option
(** [step f] is the next event, at time [due f], and the fleet after it; [None] if [due f] is. Not all that happens
    is news: the end of a task, for one, while the link is silent. *)

val quiet : t -> bool
(** [quiet f] is whether no event will ever come of [f] unless it is commanded. *)

(** {1:commands Commands}

    See {!Dolphin_runtime.Platform.S}. A vehicle that is not in the scenario is one that never answers. A stop always
    succeeds: a vehicle that does not hear it is taken to stop because it lost the link. *)

val start : Core.vehicle -> Core.platform_task -> t -> t
(** As {!Platform.S.start}. *)

val stop : Core.vehicle -> t -> t
(** As {!Platform.S.stop}. *)

val bind : Core.vehicle list -> t -> t
(** As {!Platform.S.bind}. *)

val release : Core.vehicle list -> t -> t
(** As {!Platform.S.release}. *)

val set_timer : Residual.timer -> float -> t -> t
(** As {!Platform.S.set_timer}. *)

val cancel_timer : Residual.timer -> t -> t
(** As {!Platform.S.cancel_timer}. *)

val set_connection_timeout : Core.vehicle list option -> float -> t -> t
(** As {!Platform.S.set_connection_timeout}. *)

val telemetry : Platform.telemetry -> t -> t
(** As {!Platform.S.telemetry}. *)

val look : t -> World.vehicle_state list * t
(** [look f] is the state of each vehicle that was stopped and has not been reported since, and [f] after that. *)

(** {1:displays For displays} *)

val vehicles : t -> World.vehicle_state list
(** All vehicles that were heard of, in the scenario's order: as they are now, or, without a link, as they were last
    seen. *)

val told : Core.vehicle -> t -> World.vehicle_state option
(** The last report on the vehicle. *)

val running : t -> Core.vehicle -> string option
(** [running f v] is the name of the task that [v] runs, or has been ordered to run, for the program. *)
