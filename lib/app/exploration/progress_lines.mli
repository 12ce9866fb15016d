(** Progress for a log, which nobody watches: a line every ten seconds. *)

val every_ten_seconds : (string -> unit) -> Dolphin_checker.Limits.progress -> unit
(** [every_ten_seconds print] is what may be called at any time, with how far a search has come: it prints a line for
    the first call in each ten seconds of a search but the first ten. *)

val line : Dolphin_checker.Limits.progress -> string
(** ["exploring: 120000 states, 11843/s, frontier 4021, depth 40, 12 MiB, 10 s"]. *)
