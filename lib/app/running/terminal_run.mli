(** Runs on a terminal: the log on standard output, on a live terminal the board below it, and a person who answers on
    standard input. Ctrl-C and its like interrupt the run, Ctrl-Z suspends it. *)

open Dolphin_runtime

(** The amount of output. *)
type show = {
  quiet : bool;  (** of the log only trouble and the program's messages; a summary at the end, terminal or not *)
  only : string list;  (** of the log only what is about these vehicles, and trouble; [[]]: all *)
  colour : bool option;  (** [None]: on a terminal, unless the environment has NO_COLOR *)
  journal : string option;  (** the place of the journal, for the summary *)
}

val run :
  notice:(string -> unit) -> again:(unit -> unit) -> show -> Program_file.t ->
  (Run.front -> interruption:Interruption.t -> (Driver.outcome, Error.t) result Lwt.t) ->
  (Driver.outcome * Program_file.t, Error.t) result
(** [run ~notice ~again show program f] is the result of [f], {!Run.start} or {!Run.resume} of [program] with the
    rest of its arguments, whose front is the terminal, and the program that ran last: [program], or one that replaced
    it. [notice] is that of the front. The first signal interrupts
    the run, the second one calls [again], which is to end the process, straight from its handler. It is an error if
    the log cannot be written, but not if its reader has gone: then the run is interrupted. *)
