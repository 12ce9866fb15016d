(** From which state each state was first reached, in two bits a state. Breadth first, states are expanded in the order
    of their numbers: so these are numbers that never become less, and it is enough to know where they grow. *)

type t

val create : unit -> t

val add : t -> int -> unit
(** [add t p] is called for state 0, 1, 2, ...: [p] is at least what it was for the state before. *)

val get : t -> int -> int
(** [get t i] is what was added for state [i]. *)

val bytes : t -> int
(** Memory, all outside of OCaml's heap but for 8 bytes in 512 states. *)
