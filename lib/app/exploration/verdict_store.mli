(** Verdicts of explorations that came to their end, kept for the next time that nothing has changed.

    They are in files below [$XDG_CACHE_HOME/dolphin/explore], or [~/.cache/dolphin/explore]; to remove these is
    always right. A file is named by the hash of all inputs, this executable among them, and lists these inputs
    itself: it is only used if they are the same, and if none of its bytes has changed. *)

type t
(** The question: all inputs of the verdicts. *)

val make : Exploration.settings -> Program_file.t -> Fleet_file.t -> t option
(** [make s program fleet] is the exploration of [program] with [fleet] as [s] has it; [None] if this executable cannot
    be read, or if no directory is known. *)

val find : t -> Dolphin_explore.Search.outcome option
(** The earlier result, if it is kept. *)

val keep : t -> Dolphin_explore.Search.outcome -> (unit, Error.t) result
(** [keep t o] keeps [o], unless something in it is inconclusive. The error is {!Error.Unavailable}. *)
