(** Searches that one can watch and stop. *)

module Limits := Dolphin_checker.Limits

val search :
  json:bool -> ?period:float -> (interrupted:(unit -> bool) -> progress:(Limits.progress -> unit) -> 'a) -> 'a
(** [search ~json ~period f] is the result of [f ~interrupted ~progress]. [interrupted] is true once there was a
    Ctrl-C. Progress goes to standard error: a line each [period] seconds, if that is given; else in one line of a
    terminal, or a line every 10 seconds without one; with [json] then not at all. *)
