(** Answers a simulated run by its fleet, without a terminal or a process. *)

open Dolphin_runtime

val console : Dolphin_scenario.Scenario.t -> Console.t
(** [console s] answers each question as [s] does, the first time, the second and so on. It shows nothing. A source
    whose answer was refused has no other, but for answers that are still to come. *)

val host : Dolphin_scenario.Scenario.t -> Driver.call
(** [host s] replies to each call what [s] replies first, the first time, the second and so on. *)
