(** The subjects of steps that dates are asked for. *)

open Dolphin_semantics

(** The events of a task. *)
type moment = Starts | Ends | Fails | Stopped

(** A platform task by its plan, its vehicle and its place in the program. *)
type task = Canonical_state.label = { name : string; vehicle : Core.vehicle; site : Core.site }

val deadlines : Clocked.state -> (Residual.timer * Core.site) list
(** [deadlines s] is the [within] that have begun in [s], each with its timer. *)

val tasks : Clocked.state -> Clocked.step -> (moment * task) list
(** [tasks s step] is the events of tasks with [step] of [s]. *)

val missed : Clocked.state -> Clocked.step -> Core.site option
(** [missed s step] is the [within] that is missed with [step] of [s]. *)

val task_of_part : Inert.part -> task option
(** [task_of_part p] is the task that [p] is; [None] for an [idle]. *)
