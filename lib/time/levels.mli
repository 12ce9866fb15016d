(** What is left in one vehicle's battery at the least, by its course in all states of a search: with charge, and with
    what the program sees of it. docs/time.md says why it is never less. *)

module Scenario = Dolphin_scenario.Scenario

type t = {
  least : float;  (** no run has less at any time *)
  way : Timed_system.edge list option;
  (** what leads there, and on to an end; it may be of no run. [None]: that is not known *)
}

val of_vehicle : Timed_system.t -> Scenario.vehicle -> t option
(** [of_vehicle system v] is for [system] that observes the course of [v], and whose search has come to its end. [None]
    if in some run nothing happens any more, or there are too many edges. *)
