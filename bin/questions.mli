(** Who answers a program: the command line, then the fleet, then the person at the terminal. *)

type shown = {
  ask : string -> unit;  (** shows the prompt *)
  answered : string option -> unit;  (** shows the answer behind it; [None]: it stands there *)
  refused : string -> unit;  (** tells why an answer was no good *)
}

val console :
  shown ->
  answered:(string * string) list ->
  answers:string list ->
  scenario:Dolphin_scenario.Scenario.t ->
  Dolphin_runtime.Console.t
(** [console shown ~answered ~answers ~scenario] answers with each of [answers] in turn, then with what [scenario] has
    for the prompt, then with lines of standard input. What the program says is shown by the log, not by this console.
    [answered] is the questions that were answered before, with the answers: what the fleet has given it does not give
    again.

    An answer of the fleet that is refused would be refused for ever: it is not given twice. *)
