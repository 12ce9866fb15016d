(** Runs on a terminal: the log on standard output, on a live terminal the board below it, and a person who answers on
    standard input. Ctrl-C and its like interrupt the run. *)

open Dolphin_runtime

val run :
  notice:(string -> unit) -> again:(unit -> unit) ->
  (Run.front -> interruption:Interruption.t -> (Driver.outcome, Error.t) result Lwt.t) ->
  (Driver.outcome, Error.t) result
(** [run ~notice ~again f] is the result of [f], {!Run.start} or {!Run.resume} with the rest of its arguments, whose
    front is the terminal. [notice] is that of the front. The first signal interrupts the run, the second one calls
    [again], which is to end the process, straight from its handler. It is an error if the log cannot be written, but
    not if nobody reads it any more: then the run is interrupted. *)

val is_live : unit -> bool
(** Whether standard output is a terminal on which lines can be redrawn. *)
