(** Mutable sets of numbers from 0, a bit each. *)

type t

val make : int -> t
(** [make n] is the empty set, for numbers below [n]. *)

val add : t -> int -> unit
(** [add set i] puts [i] into [set]. *)

val mem : t -> int -> bool
(** [mem set i] is whether [i] is in [set]. *)

val next : t -> int -> int option
(** [next set i] is the least member that is not below [i]. *)

val iter : (int -> unit) -> t -> unit
(** In ascending order. *)
