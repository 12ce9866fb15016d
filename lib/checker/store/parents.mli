(** The parent of each state in the tree of a breadth-first search, in two bits a state. States are expanded in the
    order of their numbers, so the parents of states 0, 1, 2, ... never decrease: only where they increase is kept. *)

type t

val create : unit -> t
(** The parents of no state. *)

val add : t -> int -> unit
(** [add t p] makes [p] the parent of the next state, from state 0 on. [p] is at least the parent before. *)

val count : t -> int
(** How many states have been given one. *)

val get : t -> int -> int
(** [get t i] is the parent of state [i]. *)

val bytes : t -> int
(** Memory in use: outside of OCaml's heap, but for 8 bytes in 512 states. *)
