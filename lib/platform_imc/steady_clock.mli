(** Seconds that pass evenly, as far as the system's time of day allows: when that is set back, this one stands still
    for the moment and then goes on. *)

type t

val make : unit -> t
(** It shows 0 now. *)

val now : t -> float
