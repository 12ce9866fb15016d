(** How long what a program waits for may take. *)

open Dolphin_semantics

type t = {
  task : Core.vehicle -> Whereabouts.t option -> Core.platform_task -> Bounds.t;
  (** from the start of a task until it is done, on a vehicle that is there then, if that is known *)
  announced : Bounds.t;  (** a [pick] without a time-out *)
  silence : Bounds.t;  (** the silence of a vehicle after which its task fails, unless the program sets another *)
  posted : string -> Bounds.t;  (** until a pair with this key is posted, from the start or the time before *)
  place : Core.vehicle -> Whereabouts.t option;  (** at the start *)
  links : Links.t;  (** when vehicles join, leave, and lose their links *)
  charges : string -> float option;
  (** the charge that an hour of the plan of this name gives the battery of its vehicle; [None]: it drains it *)
  has_chargers : Core.vehicle -> bool;  (** whether its rest charges in some places and drains in others *)
}
(** Answers and replies come at once. *)

val tolerance : float
(** 0.1: the way between two places takes up to this share less or more than by the vehicle's speed. *)

val moves : Core.platform_task -> bool
(** Whether its way is known, and has a place. *)

val links_with : Dolphin_environment.Faults.t -> t -> Links.t
(** [links_with faults d] is the [links] of [d], as far as [faults] do not let them come and go at any time: with
    [join], none; with [loss], only those of vehicles that come later. *)

val of_scenario : Dolphin_scenario.Scenario.t -> t
(** [of_scenario s] is the durations of [s]: [duration] of plans by name, [speed] of vehicles for plans that are
    described in the program, [after] of inputs, [joins], [leaves], [drops] of vehicles, [charges] of plans; some
    time, if it is silent. *)
