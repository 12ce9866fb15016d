(** The execution of a platform task by a simulated vehicle: its track, duration and outcome, settled when it starts. *)

open Dolphin_semantics
open Dolphin_scenario

type t = {
  track : Track.t;
  duration : float;  (** seconds; [infinity] for a plan without end *)
  outcome : (unit, string) result;  (** done, or why it fails *)
  charges : float option;  (** the charge that an hour of it gives the battery; [None]: it drains it *)
}

val default_duration : Scenario.duration
(** Default durations of plans: from 60 to 180 seconds. *)

val make :
  draw:(Draw.question -> float) ->
  Scenario.plan option ->
  Scenario.vehicle ->
  Dolphin_geo.Position.t ->
  Core.platform_task ->
  t
(** [make ~draw plan vehicle position task] is the execution of [task], with the scenario's entry [plan], by [vehicle]
    from [position]. [draw] decides what is left to chance.

    - A task that is only named has the duration of [plan]. If the plan has a place, the vehicle goes there, stays and
      comes back; if the plan has none, it goes round in a circle.
    - An inline plan takes as long as the vehicle needs for {!Dolphin_plans.Plan.path} at the speeds of the maneuvers,
      which are the vehicle's own where a maneuver does not give metres per second.
    - A failure happens on the way, at any time. A vehicle that does not know the plan, or may not run it, refuses at
      once. *)
