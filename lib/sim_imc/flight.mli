(** A plan as it is going to be flown: when it ends and how, and which maneuver it is at when. Times are seconds since
    its start. *)

open Dolphin_scenario

(** A maneuver, until [ends]. *)
type maneuver = { id : string; kind : int;  (** the number of its message *) ends : float }

type t = {
  execution : Dolphin_platform_sim.Simulated_execution.t;
  maneuvers : maneuver list;  (** in order; if the execution fails, some are not reached *)
}

val make :
  draw:(Dolphin_platform_sim.Draw.question -> float) ->
  Scenario.plan option ->
  Scenario.vehicle ->
  Dolphin_geo.Position.t ->
  name:string ->
  Specification.t option ->
  t
(** [make ~draw plan vehicle position ~name specification] is the flight of plan [name], from [position]. It lasts
    and ends as in {!Dolphin_platform_sim.Simulated_execution.make}. A plan without a specification is one
    maneuver, ["1"], a Goto. *)

val maneuver : t -> float -> maneuver
(** [maneuver f time] is the maneuver at [time]: the last of those that end at once when they begin. *)

val is_last : t -> maneuver -> bool
(** [is_last f m] is whether [m], a maneuver of [f], is the last one. *)

val statistics : name:string -> t -> Dolphin_imc.Message.Plan_statistics.t
(** How long it will take in whole and maneuver by maneuver. *)
