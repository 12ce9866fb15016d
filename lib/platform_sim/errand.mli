(** What a platform task comes to when a given vehicle runs it: a way, a time and an end, settled when it starts. *)

open Dolphin_semantics
open Dolphin_scenario

type t = {
  way : Track.t;
  lasts : float;  (** seconds; [infinity] for a plan without end *)
  outcome : (unit, string) result;  (** done, or why it fails *)
}

val duration : Scenario.duration
(** How long plans take whose scenario does not say: from 60 to 180 seconds. *)

val make :
  draw:(Draw.question -> float) ->
  Scenario.plan option ->
  Scenario.vehicle ->
  Dolphin_geo.Position.t ->
  Core.platform_task ->
  t
(** [make ~draw plan vehicle position task] is what [task], of which the scenario says [plan], comes to for [vehicle] at
    [position]. [draw] decides what is left to chance.

    - A task of a name takes as long as [plan] says. If the plan has a place, the vehicle goes there, stays and comes
      back; if the plan has none, it goes round in a circle.
    - An inline plan takes as long as the vehicle needs for {!Plan.path} at the speeds of the maneuvers, which are the
      vehicle's own where a maneuver does not give metres per second.
    - A failure happens on the way, at any moment. A vehicle that does not know the plan, or may not run it, refuses at
      once. *)
