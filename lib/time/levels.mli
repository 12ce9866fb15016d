(** The least charge of one vehicle's battery, by its course in all states of a search: with charging, and with the
    program's looks at it. docs/time.md shows why it is a lower bound. *)

module Scenario = Dolphin_scenario.Scenario

type t = {
  least : float;  (** no run has less at any time *)
  way : Timed_system.edge list option;
  (** the moves that lead there, and on to an end; they may belong to no run. [None]: that is not known *)
}

val of_vehicle : Timed_system.t -> Scenario.vehicle -> t option
(** [of_vehicle system v] is for [system] that observes the course of [v], and whose search has come to its end. [None]
    if in some run nothing happens any more, or there are too many edges. *)
