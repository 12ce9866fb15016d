(** Unknown values: what sensors would show that a vehicle has not told. Code may pass one on and print it. What is
    computed of it is as unknown, comparisons too, and so is [a || b] if [b] is not true. Anything else needs to know: a
    guard that does holds no longer, other code is faulty. *)

open Core

val is : value -> bool
(** Whether it is unknown. *)

(** What an operation makes of arguments some of which are unknown. *)
type applied =
  | Gives of value
  | Needs of unknown
  | As_any  (** the operation treats them as it does any values *)

val apply : operation -> value list -> applied

val iterated : Code.iteration -> value list -> (value option, unknown) result
(** [iterated i results] is what the results of an iteration come to, if some of them are unknown and that is decided
    by these; [None]: they are results as any. *)
