(** More systems than a console remembers: which of them gives way to a new one. *)

open Station_state

val most_nodes : int
(** 2000: as many systems are remembered. *)

val make_room : now:float -> t -> t option
(** [make_room ~now s] is [s] with room for one more system. If there are {!most_nodes}, one is forgotten that
    nothing is wanted of: one that never spoke to us rather than one that does not tell of plans, rather than one that
    has been silent for {!silence}; of these one of the host that has most of them, heard of least recently. [None] if
    there is none. *)

val wants : string -> t -> bool
(** [wants name s]: the program holds it, or has commanded it, or the user has named it. *)

val silence : float
(** 60 s. *)
