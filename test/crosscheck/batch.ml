open Dolphin_tlc
open Dolphin_lts
module Reference = Dolphin_explore.Reference

type verdict = Agrees | Differs of Isomorphism.difference | Not_printed
type result = { name : string; source : string; states : int; transitions : int; verdict : verdict }

type t = {
  results : result list;
  warnings : string list;
  used : string -> int;
  counted : Action_counts.count list;
}

module Rules = Set.Make (struct
    type t = Dolphin_semantics.Rule.t

    let compare = Stdlib.compare
  end)

type prepared = { case : Case.t; graph : Graph.t; transitions : int; rules : Rules.t; constants : Family.constant list }

type unfit = Refused of string | Too_large | Unsettled of string

let rules (space : Reference.t) =
  let of_edge found ((t : Dolphin_semantics.Transition.t), _) = Rules.union found (Rules.of_list t.rules) in
  Array.fold_left (List.fold_left of_edge) Rules.empty space.edges

let prepare ~limit (case : Case.t) =
  match Translated.constants case with
  | Error why -> Error (Refused why)
  | Ok constants -> (
      match Reference.explore ~limit case.environment case.program case.world with
      | None -> Error Too_large
      | exception Dolphin_environment.Environment.Unclear fault -> Error (Unsettled fault.message)
      | Some space ->
        let graph = Explored.graph ~effects:true space in
        Ok { case; graph; transitions = Reference.transitions space; rules = rules space; constants })

let case p = p.case
let constants p = p.constants
let states p = Graph.states p.graph
let transitions (p : prepared) = p.transitions
let uses p rule = Rules.mem rule p.rules

(* {1 Running TLC} *)

let rec remove path =
  if Sys.is_directory path then begin
    Array.iter (fun name -> remove (Filename.concat path name)) (Sys.readdir path);
    Unix.rmdir path
  end
  else Sys.remove path

let in_directory files f =
  let directory = Filename.temp_file "crosscheck" "" in
  Sys.remove directory;
  Unix.mkdir directory 0o700;
  let write (name, text) =
    let channel = open_out_bin (Filename.concat directory name) in
    output_string channel text;
    close_out channel
  in
  Fun.protect ~finally:(fun () -> remove directory) (fun () -> List.iter write files; f directory)

type reading = { mutable messages : Message.reader; mutable outcome : Outcome.reader; mutable problem : string option;
                 mutable warnings : string list; printed : Printed_graph.t;
                 mutable counted : Action_counts.count list }

(* SANY's warnings are lines of its own. *)
let is_warning text = Tlc_message.number_after "*** Warnings: " text <> None

let others (c : Action_counts.count) = List.filter (fun (c' : Action_counts.count) -> c'.action <> c.action)

let take r message =
  let event = Tlc_message.of_message message in
  r.outcome <- Outcome.event r.outcome event;
  let count (c : Action_counts.count) = r.counted <- c :: others c r.counted in
  Option.iter count (Action_counts.of_message message);
  match event with
  | Warning text -> r.warnings <- text :: r.warnings
  | Printed text when is_warning text -> r.warnings <- text :: r.warnings
  | Printed text -> (
      match r.problem, Printed_graph.line r.printed text with
      | None, Error problem -> r.problem <- Some (Format.asprintf "%a" Printed_graph.pp_problem problem)
      | None, Ok (true | false) | Some _, _ -> ())
  | _ -> ()

let line r text =
  let messages, complete = Message.line r.messages text in
  r.messages <- messages;
  List.iter (take r) complete

(* A wrong specification may have states without end. *)
let most_states prepared = 1_000 + List.fold_left (fun n p -> n + (2 * states p)) 0 prepared

let explore installation ~coverage ~most directory =
  let r =
    { messages = Message.start; outcome = Outcome.start; problem = None; warnings = [];
      printed = Printed_graph.create (); counted = [] }
  in
  let command =
    Invocation.command ~short:true ~coverage installation (Local (Workers 1)) ~directory ~main:"MC"
      ~configuration:(if coverage then Family.by_rule else Family.configuration)
  in
  let interrupted () = Printed_graph.states r.printed > most in
  ignore (Process.run ~directory ~interrupted (line r) command : Process.ending);
  List.iter (take r) (Message.finish r.messages);
  r

(* {1 Judging} *)

let judge graphs i p =
  let verdict =
    match List.assoc_opt (i + 1) graphs with
    | None -> Not_printed
    | Some theirs -> (
        match Compare.isomorphic p.graph theirs with Ok () -> Agrees | Error difference -> Differs difference)
  in
  { name = p.case.name; source = p.case.source; states = Graph.states p.graph; transitions = p.transitions; verdict }

(* With an action for each rule, several actions take one transition. *)
let conclude prepared ~coverage ~most r =
  let o = Outcome.finish r.outcome in
  let states = Printed_graph.states r.printed and transitions = Printed_graph.transitions r.printed in
  match r.problem, o.verdict, Printed_graph.graphs r.printed with
  | _ when states > most -> Error (Printf.sprintf "TLC was stopped after %d states" most)
  | Some problem, _, _ -> Error problem
  | None, Failed lines, _ -> Error (String.concat "\n" lines)
  | None, Gave_up why, _ -> Error why
  | None, (Violated _ | Unfinished), _ -> Error "TLC did not come to its end"
  | None, Holds, Error problem -> Error (Format.asprintf "%a" Printed_graph.pp_problem problem)
  | None, Holds, Ok _
    when o.distinct <> states || ((not coverage) && o.generated <> transitions + List.length prepared) ->
    Error
      (Printf.sprintf "TLC counts %d states and %d transitions, but %d and %d were printed" o.distinct
         (o.generated - List.length prepared) states transitions)
  | None, Holds, Ok graphs ->
    let results = List.mapi (judge graphs) prepared in
    let ours = List.fold_left (fun n (r : result) -> n + r.transitions) 0 results in
    (* In a graph, transitions between the same two states with the same label are one. *)
    if ours <> transitions && List.for_all (fun (r : result) -> r.verdict = Agrees) results then
      Error (Printf.sprintf "the explorer counts %d transitions, and TLC %d" ours transitions)
    else Ok { results; warnings = List.rev r.warnings; used = Printed_graph.used r.printed; counted = r.counted }

let run ?(coverage = false) installation ~specification prepared =
  Result.bind (Family.files ~specification (List.map (fun p -> p.constants) prepared)) (fun files ->
      let most = most_states prepared in
      in_directory files (fun directory ->
          conclude prepared ~coverage ~most (explore installation ~coverage ~most directory)))
