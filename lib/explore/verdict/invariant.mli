(** A condition that every state must meet. Where it does not ask what runs, it is evaluated once per shared state;
    otherwise in each state. *)

open Dolphin_semantics

type t

val create : Core.program -> World.t -> Condition.t -> t
val condition : t -> Condition.t

val check : t -> State_graph.t -> int -> unit
(** [check t g i] looks at state [i]; states come in the order of their numbers. *)

val broken : t -> int option
(** The first state in which it failed. *)

val trouble : t -> string option
(** What was wrong in the first state in which it could not be evaluated. *)
