(** Progress for a log, which nobody watches: a line every few seconds. *)

val every : float -> (string -> unit) -> Dolphin_checker.Limits.progress -> unit
(** [every seconds print] is what may be called at any time, with how far a search has come: it prints a line for the
    first call in each so many seconds of a search but the first. *)

val line : Dolphin_checker.Limits.progress -> string
(** ["exploring: 120000 states, 11843/s, frontier 4021, depth 40, 12 MiB, 10 s"]; of what has no states,
    ["slack, 3 of 20: 5 MiB, 10 s"]. *)
