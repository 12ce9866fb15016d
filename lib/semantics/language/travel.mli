(** How far vehicles go, how long that takes and how much of their batteries: [plan.length], [plan.duration(v)],
    [plan.energy(v)], [eta(v, p)]. The way is the one that the simulator flies ({!Dolphin_plans.Inline_plan.path}), at
    the speed of the plan or the vehicle; without one, the answer is {!Core.Unknown}. *)

open Core

(** Metres over the ground; seconds; the share of a battery, from 0 to 1. *)
type quantity = Length | Duration | Energy

val quantity : string -> quantity option
(** [quantity name] is the quantity of the method [name] of a plan, if it has one. *)

val length : platform_task -> (value, string) result
(** [length p] is the metres from the first place of [p] to the last. *)

val of_plan : World.t -> platform_task -> quantity -> World.vehicle_state -> (value, World.question) result
(** [of_plan w p q s] is [q] of [p], carried out by [s] from its place. If that may be anywhere, it is a reading. A
    plan without end takes {!infinity}. *)

val eta : World.t -> World.vehicle_state -> Dolphin_geo.Position.t -> (value, World.question) result
(** [eta w s p] is the seconds in which [s] gets from its place to [p], straight. *)
