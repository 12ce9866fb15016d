(** Effects of steps of components and nests: computed by the transition function, memoised per shared state. Shared
    states are given by their numbers. *)

open Dolphin_semantics

type t

val create : ?observe:(Local_step.t -> int) -> Components.t -> Encoding.t -> t
(** [observe local] is the number of the action of [local]; 0 by default. *)

val unknown : int
(** A guard's result that is to be found with {!guarded}. *)

val impossible : int
(** The guard does not hold. *)

val special : int
(** The code did not go well: see {!outcome}. *)

val guarded : t -> Component.step -> Component.guard -> int -> int
(** [guarded t step guard s] is the result of [guard] in shared state [s]: the shared state after it, or one of the
    above. *)

val is_settled : t -> Component.step -> int -> bool
(** [is_settled t step s] is whether [step] goes on in shared state [s] to its [successor]. *)

val action : t -> Component.step -> int -> int
(** [action t step s] is the number of the action of [step], which is [Free], and possible in shared state [s]. *)

val outcome : t -> Component.step -> int -> Component.outcome
(** [outcome t step s] is the effect of [step] in shared state [s]. *)

type surroundings
(** The parts around a step, as far as effects depend on them. *)

val surroundings : t -> ?owed:Component.owed -> Residual.surrounding list -> surroundings
(** [surroundings t ?owed around] is those with the parts [around] and the ensured deeds [owed]. It takes time, so
    callers keep it for all steps of one place. *)

val look : t -> Component.step -> surroundings -> int -> Component.outcome
(** [look t step around s] is the effect of [step], which depends on its surroundings, in shared state [s]. *)

val ends_run : Component.outcome -> bool
(** Whether the run ends by it. *)
