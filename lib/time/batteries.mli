(** What is left in batteries. docs/time.md says why it is never less than what is said. *)

open Dolphin_semantics
module Scenario = Dolphin_scenario.Scenario

val left : Scenario.vehicle -> Transition.t list -> int list -> float
(** [left v steps dates] is the least that is left in the battery of [v] during a run with these dates: under way from
    the start of each task until its end, at rest else. *)

val spans : Scenario.vehicle -> Transition.t list -> Dates.span list
(** [spans v steps] is what makes the battery of [v] low at the end of [steps], the last first: that it is long under
    way and short at rest where it is charged. *)

type way = Timed_system.edge list

val least : Timed_system.t -> Scenario.vehicle list -> (Scenario.vehicle * float * way option) list
(** [least system vs] is, for each of [vs], a bound: no run of [system], whose goal is [Latest] and whose search has
    come to its end, has less left in its battery at any time. Some run may have more, at its lowest. With it comes what
    the bound is of, which may be no run. [[]] if it is not known when the last run is over. *)
