(** Whether vehicles are looked for after a task: if not, it does not matter which ones were lost. *)

open Dolphin_semantics
open Dolphin_environment

val may_follow : Core.program -> bool
(** [may_follow p] is whether a [pick] of [p] may be evaluated after an [execute]. *)

val forgetting : Core.program -> Environment.options -> Environment.options
(** [forgetting p o] is [o] without its memory of lost vehicles, if no run of [p] depends on it. *)
