(** Seconds that pass evenly, as far as the system's time of day allows: when that is set back, this one stands still
    for the moment and then goes on. *)

type t

val make : ?time:float -> unit -> t
(** It shows [time] now, by default 0. *)

val now : t -> float
(** Seconds; it is never set back. *)
