(** The consequences of time alone: announcements, heartbeats, requests sent again, timers, silences. *)

open Station_state

val tick : now:float -> t -> t * output list
(** {!Station.tick} *)

val due : t -> float
(** {!Station.due} *)
