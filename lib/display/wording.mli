(** Small texts that the log and the board share, beside those of {!Dolphin_trace.Phrase}. *)

val duration : float -> string
(** [duration seconds] is a span of time in words: ["10 s"], ["2 min"], ["1.5 h"], ["1 h 1 min 1 s"]. *)

val vehicles : string list -> string
(** [vehicles vs] names [vs], the first ones only if there are many: ["a, b, c and 997 more"]. *)
