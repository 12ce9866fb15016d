(** What may happen to a program in the world that a fleet file describes, for exploring. *)

module Scenario := Dolphin_scenario.Scenario

val world : Scenario.t -> Dolphin_semantics.World.t
(** [world s] is the vehicles of [s] where they are at the start, all in reach. *)

val environment : answers:string list -> faults:int option option -> Scenario.t -> Dolphin_explore.Environment.options
(** [environment ~answers ~faults s] is how plans may end and what is answered. Plans end as [s] says; with [Some n]
    every plan may fail, in one run [n] times at most if [n] is a number. Each question is answered by any of [answers],
    or if there are none by what [s] answers. *)
