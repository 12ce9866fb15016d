(** More systems than a console remembers: which of them gives way to a new one. *)

open Station_state

val most_nodes : int
(** 2000: as many systems are remembered. *)

val make_room : now:float -> t -> t option
(** [make_room ~now s] is [s] with room for one more system. If there are {!most_nodes}, some are forgotten that
    nothing is wanted of, and that announced nothing for longest: of those that never spoke to us; else of those that
    have not reported what they run; else of those that have been silent for {!silence}; and of these only those of
    the host that has most of them. [None] without any. *)

val wants : string -> t -> bool
(** [wants name s]: the program holds it, or has commanded it, or the user has named it. *)

val silence : float
(** 60 s. *)
