(** The possible events of a program in the world that a fleet file describes, for exploring. *)

module Scenario := Dolphin_scenario.Scenario

val world : Scenario.t -> Dolphin_semantics.World.t
(** [world s] is the vehicles of [s], all in reach, at their places at the start. Their sensors are open: one of the
    values that [s] gives, or any if it gives only the first. *)

val seen : Scenario.t -> Dolphin_semantics.World.t -> Dolphin_semantics.World.t
(** [seen s w] is [world s] in the middle of a run that knows [w]: vehicles stand where they were seen last, with what
    they reported then; those that [s] does not have are there too, and their sensors may show any value. *)

val still : Scenario.t -> Dolphin_semantics.World.t
(** [still s] is [world s] in which sensors always show what they show at the start. *)

val environment :
  answers:string list -> faults:Faults.t -> Dolphin_semantics.Core.program -> Scenario.t -> Environment.options
(** [environment ~answers ~faults p s] is the other possible events of [p]. Plans end by [s] and by [faults]; if [p]
    or [s] has fences any plan may fail, as one that breaks a fence does. Late may be the vehicles that join, leave
    or drop in [s]; if none does, all. Each question is answered by any of [answers], or without them by the answers
    of [s]; calls of a supplier get the replies of [s]. *)
