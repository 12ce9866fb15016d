open Dolphin_semantics
open Dolphin_lts
module Graph_json = Dolphin_lts_json.Graph_json
module Reference = Dolphin_explore.Reference
module Transition_system = Dolphin_explore.Transition_system
module Limits = Dolphin_checker.Limits
module Scenario_world = Dolphin_environment.Scenario_world

type world = {
  set : (string * string) list;
  fleet : string option;
  answers : string list;
  faults : Dolphin_environment.Faults.t;
  workers : int;
  max_states : int;
  max_memory : int option;
  timeout : float option;
}

let ( let* ) = Result.bind

let too_many (program : Program_file.t) limit =
  Error.Inconclusive (Printf.sprintf "%s has more than %d states: see --max-states" program.path limit)

let explored ~limit environment (program : Program_file.t) world =
  match Reference.explore ~limit environment program.program world with
  | Some space -> Ok space
  | None -> Error (too_many program limit)
  | exception Dolphin_environment.Environment.Unclear fault -> Error (Program_file.unsettled program fault)

(* States are described from their places of discovery, when they are written. *)
let graph (program : Core.program) system builder =
  let text s = Format.asprintf "%a" (Configuration.pp program) (fst (Transition_system.state system s)) in
  Graph.Builder.finish ~doubles:true ~states:(Transition_system.states system) ~text builder

let of_program w ~interrupted ~progress path =
  let* program, fleet = Program_file.load_with_fleet ~set:w.set ~fleet:w.fleet path in
  let environment = Scenario_world.environment ~answers:w.answers ~faults:w.faults program.program fleet.scenario in
  let limits =
    Search_limits.make ~max_states:w.max_states ?max_memory:w.max_memory ?timeout:w.timeout ~interrupted ~progress () in
  let world = Scenario_world.world fleet.scenario in
  let builder = Graph.Builder.create () in
  let add = Graph.Builder.add builder in
  match Transition_system.explore ~workers:w.workers limits environment program.program world add with
  | Ok system -> Ok (graph program.program system builder)
  | Error (Stopped States) -> Error (too_many program w.max_states)
  | Error (Unclear fault) -> Error (Program_file.unsettled program fault)
  | Error (Stopped bound) -> Error (Error.Inconclusive (Format.asprintf "%s: %a" program.path Limits.pp_bound bound))

let of_text path read pp_error =
  let* text = Text_file.read path in
  Result.map_error (fun e -> Error.Bad_input (Format.asprintf "%s: %a" path pp_error e)) (read text)

let load w ~interrupted ~progress path =
  match Filename.extension path with
  | ".aut" -> of_text path Aldebaran.of_string Aldebaran.pp_error
  | ".json" -> of_text path Graph_json.of_string Graph_json.pp_error
  | _ -> of_program w ~interrupted ~progress path

type format = Aut | Dot | Json

let write format channel graph =
  let sink = output_string channel in
  match format with
  | Aut -> Aldebaran.write sink graph
  | Dot -> Graphviz.write sink graph
  | Json -> Graph_json.write sink graph
