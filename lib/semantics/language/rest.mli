(** The rest of a plan, [p.rest(v)] and [p.rest(x)]: the part of its way that was not done. So a plan that was stopped
    goes on where it stopped. *)

open Core

val from_share : platform_task -> float -> (value, string) result
(** [from_share p x] is [p] without the share [x] of its way, from 0 to 1
    ({!Dolphin_plans.Inline_plan.from_share}). An error, if the way of [p] is not known. *)

val from_reading : platform_task -> (value, string) result
(** The same for a share that is a reading: {!Dolphin_plans.Inline_plan.some_rest}. *)

val is_in_doubt : operation -> value list -> bool
(** [is_in_doubt o xs] is whether the result of [o] may depend on which part of a plan a rest of {!from_reading} is,
    which is one of [xs] or an element of one: on its way, or on whether it equals another value. *)

val of_vehicle : World.t -> platform_task -> World.vehicle_state -> (value, string) result
(** [of_vehicle w p s] is [p] without the share that [s] has done of it; all of [p], if it was not given to [s]. Where
    the progress of [s] is open, it is {!Dolphin_plans.Inline_plan.some_rest} of [p]. *)
