(** The rest of a plan, [p.rest(v)] and [p.rest(x)]: the part of its way that was not done. So a plan that was stopped
    goes on where it stopped. *)

open Core

val from_share : platform_task -> float -> (value, string) result
(** [from_share p x] is [p] without the share [x] of its way, from 0 to 1
    ({!Dolphin_plans.Inline_plan.from_share}). An error, if the way of [p] is not known. *)

val from_reading : platform_task -> (value, string) result
(** The same for a share that is a reading: {!Dolphin_plans.Inline_plan.some_rest}. *)

val has_some_rest : value -> bool
(** Whether a rest of {!from_reading} is in a value: in a list, a map, a task, or captured by code. So it is taken to
    be in a value of more than {!Value.most_items} parts. *)

val has_plan : value -> bool
(** The same for any inline plan. *)

val may_equal : value -> value -> bool
(** [may_equal x y] is whether [x] equals [y] for some parts that the rests of {!from_reading} in them may be, and has
    such rests. *)

val in_doubt : site -> Fault.t
(** The result of an operation that {!is_in_doubt}. *)

val is_in_doubt : operation -> value list -> bool
(** [is_in_doubt o xs] is whether the result of [o] may depend on which part of a plan a rest of {!from_reading} is,
    which is in [xs]: on its way, on whether it equals another value, or on their order. That of [consume] and [poll]
    depends on N, too, and is not seen here. *)

val of_vehicle : World.t -> platform_task -> World.vehicle_state -> (value, string) result
(** [of_vehicle w p s] is [p] without the share that [s] has done of it; all of [p], if it was not given to [s]. Where
    the progress of [s] is open, it is {!Dolphin_plans.Inline_plan.some_rest} of [p]. *)
