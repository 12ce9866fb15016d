(** Least charges of batteries. docs/time.md shows why they are lower bounds. *)

open Dolphin_semantics
module Scenario = Dolphin_scenario.Scenario

(** That a vehicle sets out to carry a task out, or ceases to, or goes over to a plan that charges. *)
type turn = {
  vehicle : Core.vehicle;
  doing : Dolphin_scenario.Battery.doing;
  at : int;  (** milliseconds since the start *)
}

val turns : Clocked.options -> Clocked.state -> Clocked.step list -> int list -> turn list
(** [turns o s steps dates] is those of a run from [s] with these dates. *)

val left : Scenario.vehicle -> turn list -> until:int -> float
(** [left v turns ~until] is the least that is left in the battery of [v] during a run with these turns that ends at
    [until]. *)

val spans : Clocked.options -> Scenario.vehicle -> Clocked.state -> Clocked.step list -> Dates.span list
(** [spans o v s steps] is the spans that make the battery of [v] low at the end of [steps] from [s], the last first:
    long ones where it is drained, and short ones where it is charged. *)

type way = Timed_system.edge list
(** A way through the graph of a {!Timed_system}, from state 0. *)

val least : Timed_system.t -> Scenario.vehicle list -> (Scenario.vehicle * float * way option) list
(** [least system vs] is, for each of [vs], a bound: no run of [system], whose goal is [Latest] and whose search has
    come to its end, has less left in its battery at any time. Some run may have more, at its lowest. With it comes
    the way of the bound, which may belong to no run. [[]] if it is not known when the last run is over. *)
