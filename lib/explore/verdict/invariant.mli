(** A condition that every state must meet. Where it does not ask what runs, the states that share store, N and B are
    looked at once; otherwise each state is. *)

open Dolphin_semantics

type t

val create : Core.program -> World.t -> Condition.t -> t
val condition : t -> Condition.t

val check : t -> Space.t -> int -> unit
(** [check t s i] looks at state [i]; states come in the order of their numbers. *)

val broken : t -> int option
(** The first state in which it failed. *)

val trouble : t -> string option
(** What was wrong in the first state in which it could not be told. *)
