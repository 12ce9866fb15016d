(** Vehicles of a console that died and is taken over from, until they have reported their plans: the actions for
    them then. *)

open Dolphin_semantics
open Dolphin_runtime

type t

val none : t
(** No vehicle is expected. *)

val resume :
  deadline:(Core.vehicle -> float) ->
  lingering:(Core.vehicle * (string * int)) list ->
  History.outstanding ->
  t
(** [resume ~deadline ~lingering outstanding] expects the vehicles that were bound, or commanded: their orders are
    continued, or halted if they were stopped. A task of a vehicle [v] that is not heard by [deadline v] (s) has
    failed. Those of [lingering] ({!Durable_note.lingering}) are halted, too. *)

val mem : Core.vehicle -> t -> bool
(** Whether the vehicle is expected. *)

val order_of : Core.platform_task -> (Execution.order, string) result
(** The order that the task is to a vehicle: a plan of maneuvers goes along, others are known by name. The error is
    the reason why IMC has no such order: for missions of items. *)

val start : deadline:float -> Core.vehicle -> Execution.order -> t -> t
(** [start ~deadline v order x]: [v], which is expected or will be, is to run [order], once what it runs is stopped. *)

val stop : Core.vehicle -> t -> t
(** [stop v x]: the vehicle's order is to be halted, unless that is over, or was never sent. *)

val stop_all : t -> t
(** {!stop} of each vehicle that is expected. *)

val heard : Core.vehicle -> t -> Execution.input list * t
(** [heard v x] is the inputs for the execution on [v], in order, as [v] has reported its plan. *)

val postpone : float -> t -> t
(** [postpone seconds x] is [x] with later deadlines. *)

val give_up : now:float -> t -> (Core.vehicle * Durable_note.t option) list * t
(** [give_up ~now x] is the vehicles that were not heard in time: their tasks have failed, and are to be halted; with
    the notes on that. *)

val due : t -> float
(** When {!give_up} has something to do; [infinity] if never. *)

val halting : Core.vehicle -> t -> string option
(** The plan that is to be halted on the vehicle. *)

val halts : t -> (Core.vehicle * string) list
(** The vehicles that are yet to be halted, with the plans. *)
