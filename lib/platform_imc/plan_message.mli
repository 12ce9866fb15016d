(** Inline plans as vehicles take them: {!Dolphin_plans.Plan.t} as a PlanSpecification.

    Source: IMC, PlanSpecification, PlanManeuver, PlanTransition and the maneuvers; measured with DUNE 2026.01, which
    follows the first transition of a maneuver with any condition, and ends the plan after the last one. *)

open Dolphin_plans
open Dolphin_imc

val of_plan : Plan.t -> Message.t Message.Plan_specification.t
(** [of_plan p] is [p] with the maneuvers in a row, each joined to the next by a transition on [maneuverIsDone]; the
    first one starts. The payload of a maneuver becomes its start actions, one SetEntityParameters for each device.

    Degrees become radians. Lengths, speeds and times stay as they are, but for the amplitude of [Yo_yo]: a plan gives
    the difference between the deepest and the shallowest point, IMC the amplitude around [z], which is half of it.
    Defaults of a plan: a maneuver's timeout is {!timeout}, the radius in which [Pop_up] keeps its station is
    {!pop_up_radius}, a loiter is circular, attitudes are 0.

    [p.vehicles] is not part of the message: allocation decides the vehicle of a plan. *)

val timeout : int
(** 65535 s: no limit of ours. Some vehicles fail a maneuver that takes longer; DUNE was not seen to. *)

val pop_up_radius : float
(** 20 m, the default radius of [skeeping]. *)
