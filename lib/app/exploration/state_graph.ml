open Dolphin_semantics
open Dolphin_lts
module Reference = Dolphin_explore.Reference
module Scenario_world = Dolphin_environment.Scenario_world

type world = {
  set : (string * string) list;
  fleet : string option;
  answers : string list;
  faults : Dolphin_environment.Faults.t;
  limit : int;
}

let ( let* ) = Result.bind

let graph (program : Core.program) (space : Reference.t) =
  let builder = Graph.Builder.create () in
  let add from ((t : Transition.t), target) =
    Graph.Builder.add builder from (Format.asprintf "%a" Label.pp t.label) target in
  Array.iteri (fun from edges -> List.iter (add from) edges) space.edges;
  let text s = Format.asprintf "%a" (Configuration.pp program) space.states.(s).configuration in
  Graph.Builder.finish ~doubles:true ~states:(Array.length space.states) ~text builder

let explored ~limit environment (program : Program_file.t) world =
  match Reference.explore ~limit environment program.program world with
  | Some space -> Ok space
  | None ->
    Error (Error.Inconclusive (Printf.sprintf "%s has more than %d states: see --max-states" program.path limit))
  | exception Dolphin_environment.Environment.Unclear fault -> Error (Program_file.unsettled program fault)

let of_program w path =
  let* program, fleet = Program_file.load_with_fleet ~set:w.set ~fleet:w.fleet path in
  let environment = Scenario_world.environment ~answers:w.answers ~faults:w.faults program.program fleet.scenario in
  let* space = explored ~limit:w.limit environment program (Scenario_world.world fleet.scenario) in
  Ok (graph program.program space)

let of_text path read pp_error =
  let* text = Text_file.read path in
  Result.map_error (fun e -> Error.Bad_input (Format.asprintf "%s: %a" path pp_error e)) (read text)

let load w path =
  match Filename.extension path with
  | ".aut" -> of_text path Aldebaran.of_string Aldebaran.pp_error
  | ".json" -> of_text path Json.of_string Json.pp_error
  | _ -> of_program w path

type format = Aut | Dot | Json

let write format channel graph =
  let sink = output_string channel in
  match format with
  | Aut -> Aldebaran.write sink graph
  | Dot -> Graphviz.write sink graph
  | Json -> Json.write sink graph
