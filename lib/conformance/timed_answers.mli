(** The oracle's answers about times: [dolphin time] and [trace check --timed], of a program and a fleet. *)

open Dolphin_semantics

(** The program and the fleet that questions are about. *)
type given = { program : Core.program; scenario : Dolphin_scenario.Scenario.t }

val times : faults:Dolphin_environment.Faults.t -> given -> (Timed_data.times, string) result
(** [times ~faults g] is the earliest and latest dates of all runs; or why they are not found. *)

val dated :
  faults:Dolphin_environment.Faults.t -> given -> (int * Dolphin_trace.Event.t) list ->
  (Timed_data.finding list, string) result
(** [dated ~faults g run] is the events that were too early or too late in the run with these events and dates. Steps
    without events are taken at once, leftmost first. The error is the reason why it is not a run. *)
