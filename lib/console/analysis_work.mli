(** The work of analyses that parses programs or results: done in the processes of {!Worker}. *)

open Dolphin_json
open Exchange

val prepare : Analysis.subject -> Workspace.t -> Field.members -> (json, refusal) result
(** [prepare subject w found] is {!Analysis.json_of_order} of the analysis that a request with the members [found] asks
    for. *)

val conclude : Workspace.t -> Dolphin_http.Request.t -> (json, refusal) result
(** [conclude w r] is the [result] as the command has it with [--json], of the output that is the body of [r], and the
    [counterexample]: the run in the file [witness], each step as a line of a journal with the words of the log;
    [null] if there is none, or if the program or the fleet has changed since. [order] in the query is
    {!Analysis.json_of_order}. *)

val witnessed :
  Workspace.t -> Analysis.order -> Dolphin_trace.Witness.t ->
  (Dolphin_app.Program_file.t * Dolphin_app.Fleet_file.t, refusal) result
(** The program and the fleet that a run was found in; refused as ["changed"] if their files have other texts now. *)
