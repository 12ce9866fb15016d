(** Unknown values: sensor values that a vehicle has not reported. Code may pass one on and print it. A result
    computed of it is as unknown, comparisons too, and so is [a || b] if [b] is not true. Anything else needs to
    know: a guard that does holds no longer, other code is faulty. *)

open Core

val is : value -> bool
(** Whether it is unknown. *)

(** The result of an operation for arguments some of which are unknown. *)
type applied =
  | Gives of value
  | Needs of unknown
  | As_any  (** the operation treats them as it does any values *)

val apply : operation -> value list -> applied
(** [apply o xs] is the result of [o] for [xs]. *)

val iterated : Code.iteration -> value list -> (value option, unknown) result
(** [iterated i results] is the combined results of an iteration, if some of them are unknown and decide it; [None]:
    they are results as any. *)
