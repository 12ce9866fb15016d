open Dolphin_semantics
module Codec = Dolphin_json.Codec
module Graph = Dolphin_lts.Graph
module Property = Dolphin_explore.Property
module Transition_system = Dolphin_explore.Transition_system
module Environment = Dolphin_environment.Environment
module Faults = Dolphin_environment.Faults
module Scenario_world = Dolphin_environment.Scenario_world
module Limits = Dolphin_checker.Limits
module Header = Dolphin_trace.Header

let ( let* ) = Result.bind

type header = {
  program : Header.source;
  fleet : Header.source option;
  answers : string list;
  faults : Faults.t;
  holds : Property.t list;
  states : int;
  transitions : int;
}

type edge = { label : string; target : int; digest : int option }
type t = { header : header; edges : edge list array }

let certifiable : Property.t list =
  [ No_deadlock; No_error; Assertions; Vehicles; Allocation; No_halt; No_leftover ]

(* Values that are equal may be printed in several ways. *)
let digest program ((c : Configuration.t), e) =
  let control = Format.asprintf "%a" (Configuration.pp program) { c with shared = Shared.initial program } in
  Hashtbl.hash (control, Configuration.hash c, Environment.hash e)

(* {1 Making} *)

let with_digests program system edges =
  let is_ambiguous e = List.exists (fun e' -> e'.label = e.label && e'.target <> e.target) edges in
  let digested e = { e with digest = Some (digest program (Transition_system.state system e.target)) } in
  List.map (fun e -> if is_ambiguous e then digested e else e) edges

(* A certificate has all states, also those that no world reaches. *)
let holding (o : Dolphin_explore.Search.outcome) =
  let holds property =
    match List.assoc_opt property o.verdicts with
    | Some Holds -> not (List.mem property o.only_in_worlds)
    | Some (Holds_if _ | Violated _ | By_design _ | Unreached _ | Inconclusive _) | None -> false
  in
  List.filter holds certifiable

let edges ?workers limits environment program world =
  let builder = Graph.Builder.create () in
  let of_system system =
    let states = Transition_system.states system in
    let graph = Graph.Builder.finish ~doubles:true ~states builder in
    let add edges l target = { label = Graph.label graph l; target; digest = None } :: edges in
    let of_state i = List.rev (Graph.fold_from graph i add []) in
    Array.init states (fun i -> with_digests program system (of_state i))
  in
  Result.map of_system
    (Transition_system.explore ?workers limits environment program world (Graph.Builder.add builder))

let make ~interrupted ~progress (s : Exploration.settings) (program : Program_file.t) (fleet : Fleet_file.t) outcome =
  let core = program.program in
  let environment = Scenario_world.environment ~answers:s.answers ~faults:s.faults core fleet.scenario in
  let limits =
    Search_limits.make ?max_states:s.max_states ?max_depth:s.max_depth ?max_memory:s.max_memory ?timeout:s.timeout
      ~interrupted ~progress () in
  match edges ~workers:s.workers limits environment core (Scenario_world.world fleet.scenario) with
  | Error (Unclear fault) -> Error (Program_file.unsettled program fault)
  | Error (Stopped bound) ->
    Error (Error.Inconclusive (Format.asprintf "no certificate is written: %a" Limits.pp_bound bound))
  | Ok edges ->
    let transitions = Array.fold_left (fun n edges -> n + List.length edges) 0 edges in
    let header =
      { program = Program_file.header program; fleet = Fleet_file.header fleet; answers = s.answers; faults = s.faults;
        holds = holding outcome; states = Array.length edges; transitions } in
    Ok { header; edges }

(* {1 Files} *)

let faults = Codec.conv Faults.of_string (Format.asprintf "%a" Faults.pp) Codec.text

let property = Codec.enum (List.map (fun property -> (Property.name property, property)) certifiable)

(* With the labels. *)
let header_codec =
  let open Codec in
  closed
    (let+ () = fixed "format" (`String "dolphin-certificate")
     and+ () = fixed "version" (`Int 1)
     and+ program = field "program" Header.source_codec (fun (h, _) -> h.program)
     and+ fleet = optional "fleet" Header.source_codec (fun (h, _) -> h.fleet)
     and+ answers = default [] "answers" (list text) (fun (h, _) -> h.answers)
     and+ faults = default Faults.none "faults" faults (fun (h, _) -> h.faults)
     and+ holds = field "holds" (list property) (fun (h, _) -> h.holds)
     and+ states = field "states" (whole ~least:1 ()) (fun (h, _) -> h.states)
     and+ transitions = field "transitions" count (fun (h, _) -> h.transitions)
     and+ labels = field "labels" (list text) snd in
     ({ program; fleet; answers; faults; holds; states; transitions }, labels))

(* The labels in the order in which they come, and their numbers. *)
let numbered edges =
  let numbers = Hashtbl.create 100 and labels = ref [] in
  let number e =
    if not (Hashtbl.mem numbers e.label) then begin
      Hashtbl.add numbers e.label (Hashtbl.length numbers);
      labels := e.label :: !labels
    end
  in
  Array.iter (List.iter number) edges;
  (Hashtbl.find numbers, List.rev !labels)

let write path { header; edges } =
  let number, labels = numbered edges in
  let edge { label; target; digest } =
    let parts = number label :: target :: Option.to_list digest in
    Printf.sprintf "[%s]" (String.concat "," (List.map string_of_int parts))
  in
  Text_file.write path (fun channel ->
      Printf.fprintf channel "%s\n" (Codec.to_string header_codec (header, labels));
      Array.iter (fun edges -> Printf.fprintf channel "[%s]\n" (String.concat "," (List.map edge edges))) edges)

let edge ~states labels : Yojson.Safe.t -> edge option = function
  | `List (`Int label :: `Int target :: rest)
    when 0 <= label && label < Array.length labels && 0 <= target && target < states -> (
      match rest with
      | [] -> Some { label = labels.(label); target; digest = None }
      | [ `Int digest ] -> Some { label = labels.(label); target; digest = Some digest }
      | _ -> None)
  | _ -> None

(* [n] is the number of the line, for messages. *)
let line path channel n read =
  let wrong why = Error (Error.Bad_input (Printf.sprintf "%s:%d: %s" path n why)) in
  match Dolphin_json.Host_value.parse (input_line channel) with
  | Ok json -> Result.fold (read json) ~ok:Result.ok ~error:wrong
  | Error _ -> wrong "not a line of JSON"
  | exception End_of_file -> wrong "the certificate ends before its last state"

let read path =
  Text_file.with_channel path @@ fun channel ->
  let* header, labels = line path channel 1 (Codec.read header_codec) in
  let labels = Array.of_list labels in
  let transitions : Yojson.Safe.t -> (edge list, string) result = function
    | `List edges -> (
        match List.filter_map (edge ~states:header.states labels) edges with
        | found when List.compare_lengths found edges = 0 -> Ok found
        | _ -> Error "a transition is [label, state] or [label, state, digest]")
    | _ -> Error "not the list of the transitions of a state"
  in
  let rec states found n =
    if n = header.states then
      match input_char channel with
      | _ -> Error (Error.Bad_input (Printf.sprintf "%s:%d: more lines than states" path (n + 2)))
      | exception End_of_file -> Ok (List.rev found)
    else
      let* edges = line path channel (n + 2) transitions in
      states (edges :: found) (n + 1)
  in
  let* edges = states [] 0 in
  Ok { header; edges = Array.of_list edges }
