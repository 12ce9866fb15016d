(** Who answers a program's questions: those who started it, then the fleet, then a person. *)

(** The person, and what they see. *)
type person = {
  asked : string -> unit;  (** shows the question *)
  answer : string -> (string, string) result Lwt.t;
  (** [answer prompt] is what they answer to the question just shown, or why nobody does. It may be cancelled. *)
  answered : string -> unit;  (** shows the answer that somebody else gave *)
  refused : string -> unit;  (** tells why an answer was no good; the question is asked again *)
}

val nobody : person
(** Sees nothing, and does not answer. *)

val console :
  person ->
  answered:(string * string) list ->
  answers:string list ->
  scenario:Dolphin_scenario.Scenario.t ->
  Dolphin_runtime.Console.t
(** [console person ~answered ~answers ~scenario] answers with each of [answers] in turn, then with what [scenario] has
    for the prompt, then as [person] does. It does not show what the program says: fronts read that in the transitions.
    [answered] is the questions that were answered before, with the answers: what the fleet gave of these it does not
    give again.

    An answer of the fleet that is refused would be refused for ever: it is not given twice. *)
