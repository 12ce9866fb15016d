open Dolphin_semantics
module Witness = Dolphin_trace.Witness
module Scenario_world = Dolphin_environment.Scenario_world

type run = { breaks : string; description : string; steps : Transition.t list; cycle : Transition.t list }

let witness (program : Program_file.t) (fleet : Fleet_file.t) run =
  let steps = Witness.steps program.program (Scenario_world.world fleet.scenario) in
  let initial = Configuration.initial program.program in
  let last (_ : Configuration.t) (t : Transition.t) = t.next in
  Witness.to_lines
    { program = Program_file.header program;
      fleet = Fleet_file.header fleet;
      property = run.breaks;
      steps = steps initial run.steps;
      cycle = steps (List.fold_left last initial run.steps) run.cycle }

let informal_trace (program : Program_file.t) { description; steps; cycle; breaks = _ } =
  let initial = Configuration.initial program.program in
  [ Yojson.Safe.to_string (Dolphin_trace.Itf.trace program.program ~description initial steps ~cycle) ]

let write program fleet path run =
  Text_file.write path (fun channel ->
      let lines =
        if Filename.check_suffix path ".itf.json" then informal_trace program run else witness program fleet run
      in
      List.iter (fun line -> output_string channel (line ^ "\n")) lines)

let read path =
  let of_text text =
    let lines = List.filter (fun line -> line <> "") (String.split_on_char '\n' text) in
    Result.map_error (fun why -> Error.Bad_input (Printf.sprintf "%s: %s" path why)) (Witness.of_lines lines)
  in
  Result.bind (Text_file.read path) of_text

let settings path =
  Option.map (fun (found : Witness.t) -> found.program.set) (Result.to_option (read path))
