(** How long what a program waits for may take. *)

open Dolphin_semantics

type t = {
  task : Core.vehicle -> Dolphin_geo.Position.t option -> Core.platform_task -> Bounds.t;
  (** from the start of a task until it is done, on a vehicle that is at this place then, if that is known *)
  announced : Bounds.t;  (** a [pick] without a time-out *)
  silence : Bounds.t;  (** how long nothing is heard of a vehicle before its task fails, unless the program says so *)
  posted : string -> Bounds.t;  (** until a pair with this key is posted, from the start or the time before *)
  place : Core.vehicle -> Dolphin_geo.Position.t option;  (** at the start *)
  links : Links.t;  (** when vehicles join, leave, and lose their links *)
  charges : string -> float option;
  (** what an hour of the plan of this name gives the battery of its vehicle; [None]: it drains it *)
}
(** Answers and replies come at once. *)

val tolerance : float
(** 0.1: the way between two places takes by so much less or more than the vehicle's speed says. *)

val moves : Core.platform_task -> Dolphin_geo.Position.t option option
(** [moves p] is where [p] leaves its vehicle, if that is elsewhere than where it was: [Some None] if that depends on
    where it was. *)

val links_with : Dolphin_environment.Faults.t -> t -> Links.t
(** [links_with faults d] is the [links] of [d], as far as [faults] do not let them come and go at any time: with
    [join], none; with [loss], only those of vehicles that come later. *)

val of_scenario : Dolphin_scenario.Scenario.t -> t
(** [of_scenario s] is what [s] says: [duration] of plans by name, [speed] of vehicles for plans that are described in
    the program, [after] of inputs, [joins], [leaves], [drops] of vehicles, [charges] of plans; some time, where it says
    nothing. *)
