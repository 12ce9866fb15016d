(** Fields: the value of a quantity at each place and time, from samples of it. *)

val value : Entry.sample list -> string -> Dolphin_geo.Position.t -> time:float -> float option
(** [value samples q p ~time] is the quantity [q] at [p]: the mean of its samples' places, each weighted by the
    inverse square of its distance from [p]; within 1 cm of a place, its sample. A place with several samples goes
    from one to the next in the course of time, in a straight line, and stays as it is before the first and after the
    last. Heights do not count. [None]: [q] has no samples. *)

val still_from : Entry.sample list -> float
(** [still_from samples] is the time from which no field changes any more. *)
