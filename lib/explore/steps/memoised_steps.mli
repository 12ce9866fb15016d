(** What steps of parts and of nests do when so and so is shared, each worked out once, by the transition function. *)

open Dolphin_semantics

module Shareds : module type of Dolphin_checker.Interner.Make (Surroundings)

type t

val create : ?observe:(Local_step.t -> int) -> Components.t -> t
(** [observe local] is a number for what a step did, kept as the [action] of steps, guards and cases; 0 by default. *)

val shareds : t -> Shareds.t

val unknown : int
(** A guard's result that is to be found with {!guarded}. *)

val impossible : int
(** The guard does not hold. *)

val special : int
(** The code did not go well: see {!case}. *)

val guarded : t -> Component.step -> Component.guard -> int -> int
(** [guarded t step guard s] is the result of [guard] for shared number [s]: the number of what is shared after it, or
    one of the above. *)

val action : t -> Component.step -> int -> int
(** [action t step s] is the number of what [step], which is [Free], does; it is possible when [s] is shared. *)

val case : t -> Component.step -> int -> Component.case
(** [case t step s] is what [step] does when [s] is shared. *)
