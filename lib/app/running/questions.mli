(** The sources of answers to a program's questions: the command line, then the fleet, then a person. *)

(** The person, and the display for them. *)
type person = {
  asked : string -> unit;  (** shows the question *)
  answer : string -> (string, string) result Lwt.t;
  (** [answer prompt] is their answer to the question just shown, or the reason why there is none. It may be
      cancelled. *)
  answered : string -> unit;  (** shows the answer that another source gave *)
  refused : string -> unit;  (** reports why an answer was refused; the question is asked again *)
}

val nobody : person
(** Sees nothing, and does not answer. *)

val console :
  person ->
  answered:(string * string) list ->
  answers:string list ->
  scenario:Dolphin_scenario.Scenario.t ->
  Dolphin_runtime.Console.t
(** [console person ~answered ~answers ~scenario] answers with each of [answers] in turn, then with the answers of
    [scenario] for the prompt, then as [person] does. It does not show the program's messages: fronts read them in the
    transitions. [answered] is the questions that were answered before, with the answers: it does not give the fleet's
    ones among these again.

    An answer of the fleet that is refused would be refused each time: it is not given twice. *)
