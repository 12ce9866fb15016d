(** The units of numbers. *)

val factor : string -> float option
(** [factor name] is the factor of [n.name], as in [2.km]: results are in metres, degrees, seconds, or shares of 1. *)

val names : string list
(** All names that {!factor} knows. *)
