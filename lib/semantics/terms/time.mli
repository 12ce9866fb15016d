(** Times that timers wait, in seconds. *)

val longest : float
(** 1e12, some 30,000 years: timers wait for less. *)

val is_one : float -> bool
(** [is_one s] is [0 <= s < longest]. *)

val none : string -> float -> string
(** [none what s] is the reason why [what], as ["idle"], does not take [s], which is not a time. *)
