(** A table that numbers the signatures met in one round of {!Refinement}. *)

type t

val create : unit -> t
(** An empty table. *)

val clear : t -> unit
(** Forgets all signatures, in time proportional to how many there are. *)

val start : t -> int -> unit
(** [start t block] starts the signature of a state in [block]. *)

val add : t -> label:int -> block:int -> unit
(** Adds to the signature that was started: a transition with [label] to a state in [block]. *)

val finish : counting:bool -> t -> int
(** Ends the signature: its number. Equal signatures, of states in the same block, have the same number; new ones are
    numbered in sequence from 0. Order does not matter, and unless [counting] neither does repetition. *)

val count : t -> int
(** How many different signatures there are. *)
