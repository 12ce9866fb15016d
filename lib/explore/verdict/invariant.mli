(** A condition that every state must meet. If it does not ask for running tasks, it is evaluated once per shared
    state; otherwise in each state. *)

open Dolphin_semantics

type t

val create : Core.program -> World.t -> Condition.t -> t
(** [create p w condition] has looked at no state. *)

val condition : t -> Condition.t
(** The condition of {!create}. *)

val check : t -> State_graph.t -> int -> unit
(** [check t g i] looks at state [i]; states come level by level. *)

val broken : t -> int option
(** The first state in which it failed. *)

val told : t -> string
(** As [told] of a {!Dolphin_checker.Watcher.t}. *)

val hear : t -> first:(int -> int -> int) -> string -> unit
(** As of a {!Dolphin_checker.Watcher.t}. *)

val trouble : t -> string option
(** The error in the first state in which it could not be evaluated. *)
