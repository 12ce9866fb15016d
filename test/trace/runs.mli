(** Runs of the examples on their fleets, with their journals. *)

open Dolphin_semantics

type t = {
  name : string;
  program : Core.program;
  hash : string;  (** of the program's text *)
  journal : string;
  scenario : Dolphin_scenario.Scenario.t;
  seed : int;
  period : float option;
  host : unit -> Dolphin_runtime.Host.t option;
}

val examples : string list
(** The names of all examples, ["all_of"], ["water_survey"]. *)

val run : ?seed:int -> ?period:float -> string -> t
(** [run name] is a run of the example [name] on the fleet beside it. *)

val of_text : ?period:float -> string -> t
(** [of_text source] is a run of this program on the built-in fleet. *)

val of_scenario : ?period:float -> ?seed:int -> Dolphin_scenario.Scenario.t -> string -> t

val resume : t -> string -> (string, string) result
(** [resume r text] is the joined journal of a run of [r]'s program that goes on where [text], the journal of a
    console that died, breaks off; or the reason why it cannot. *)

val check : t -> Dolphin_trace.Journal_verdict.t
(** The verdict on its journal. *)

val check_text : t -> string -> Dolphin_trace.Journal_verdict.t
(** [check_text r journal] is the verdict on [journal] as one of [r]'s program. *)

val lines : string -> string list
(** The lines of a journal. *)

val text : string list -> string
(** And back. *)
