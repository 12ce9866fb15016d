(** The simulated fleet behind the platform protocol ([docs/platform.md]), as a pure state: orders and time go in,
    reports come out. Times are seconds of the fleet. *)

open Dolphin_platform_protocol

type t

val create : seed:int -> is_remembered:bool -> Dolphin_scenario.Scenario.t -> t
(** At time 0. [is_remembered]: the commander of this fleet has all of its orders, so a request that it does not know
    was never ordered. *)

val greeting : Report.t
(** The report with which an adapter greets. *)

val order : now:float -> Order.t -> t -> t * Report.t list
(** [order ~now o f] is [f] after it was ordered [o], at [now] if that is not before what has happened. *)

val changes : Order.t -> t -> bool
(** Whether the order changes what a vehicle does: these orders rebuild the same fleet. *)

val advance : until:float -> t -> t * Report.t list
(** All that happens up to this time. *)

val due : t -> float option
(** When something happens next. *)

val everyone : t -> Report.t list
(** The reports on each vehicle that was heard of. *)
