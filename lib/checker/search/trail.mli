(** The data of a depth-first search: the {e path} to its present state, and the states that {e wait}. *)

(** A state of the path, or one that waits. *)
type entry = {
  state : int array;
  depth : int;  (** transitions from the initial state *)
  hash : int;  (** of the state, however it is encoded *)
}

type t

val create : unit -> t
(** No path, and no state that waits. *)

val waiting : t -> int
(** How many states wait. *)

val push : t -> entry -> unit
(** [push t e] lets [e] wait: it was found from the last state of the path. *)

val pop : t -> entry option
(** [pop t] is the last that was pushed of those that wait, which does so no more. *)

val drop_to : t -> int -> unit
(** [drop_to t n] leaves waiting only the first [n] that were pushed. *)

val enter : t -> entry -> unit
(** [enter t e], where [e] was just popped, makes the path that to [e]: through the states from which it was found. *)

val path : t -> int array list
(** The states of the path, from the initial one on. *)

val depth_on_path : t -> hash:int -> int array -> int option
(** [depth_on_path t ~hash s] is how deep the path goes through [s], if it does and no other of this hash came there
    later. *)

val rewrite : t -> (int array -> int array) -> unit
(** [rewrite t f] is for a new encoding: each state [s] is [f s] now. *)
