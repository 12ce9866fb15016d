(** Which vehicles run which tasks: in one run, in which all goes well and sensors show what they show at the start. *)

open Dolphin_semantics

val of_program : Core.program -> Dolphin_scenario.Scenario.t -> (Dolphin_syntax.Location.t * Core.vehicle list) list
(** [of_program p s] is the places where [p] makes a task that a vehicle of [s] starts, in the order of the text,
    each with these vehicles in the order of their starts. Later steps than the 2,000th are not considered. *)
