(** Progress for a log file: a line every few seconds. *)

val every : float -> (string -> unit) -> Dolphin_checker.Limits.progress -> unit
(** [every seconds print] may be called at any time, with the progress of a search: it prints a line for the first
    call in each period of [seconds] seconds but the first. *)

val line : Dolphin_checker.Limits.progress -> string
(** ["exploring: 120000 states, 11843/s, frontier 4021, depth 40, 12 MiB, 10 s"]; for phases without states, ["slack,
    3 of 20: 5 MiB, 10 s"]. *)
