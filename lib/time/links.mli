(** When the links of a fleet's vehicles come and go, by its file: one change after another. *)

open Dolphin_semantics

type t

val none : t
(** All are heard of all the time. *)

val of_silences : (Core.vehicle * (float * float) list) list -> t
(** [of_silences l] is the links of vehicles of which nothing is heard from the first to the second of each pair of
    seconds since the start, which are as {!Dolphin_scenario.Scenario.silences} has them. Of changes at one date the
    one comes first whose vehicle's change before came first, or else whose vehicle stands first in [l]: the
    simulator's order. *)

val only_first : t -> t
(** [only_first l] is [l] in which vehicles are heard of all the time once they were. *)

val late : t -> Core.vehicle list
(** The vehicles that are not heard of at the start, in the order in which they are for the first time; those that never
    are come last. *)

val count : t -> int
(** How many changes there are. *)

val change : t -> int -> Core.vehicle * int
(** [change l k] is the vehicle of change [k], from 0, and how many milliseconds after the start it comes. *)

val changes : t -> (Core.vehicle * int) list
(** All of them. *)

val may_go : t -> Core.vehicle -> bool
(** [may_go l v] is whether the link of [v] goes after there was one. *)

val words : t -> int -> string
(** Change [k] in words: ["b joins"], ["b's link goes"], ["b's link is back"]. *)

val next : t -> int -> matters:(Core.vehicle -> bool) -> int
(** [next l k ~matters] is the first change from [k] on of a vehicle that [matters], or [count l]. *)

val silent : t -> int -> Core.vehicle list
(** [silent l k] is the vehicles that are not heard of after the changes before [k], in the order of {!of_silences}. *)

val is_silent : t -> int -> Core.vehicle -> bool
(** [is_silent l k v] is whether [v] is among [silent l k]. *)
