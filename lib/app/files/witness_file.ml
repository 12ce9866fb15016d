open Dolphin_plans
open Dolphin_semantics
open Dolphin_trace
module Scenario_world = Dolphin_environment.Scenario_world

type run = { breaks : string; description : string; steps : Transition.t list; cycle : Transition.t list }

let witness (program : Program_file.t) (fleet : Fleet_file.t) run =
  let steps = Witness.steps program.program (Scenario_world.world fleet.scenario) in
  let initial = Configuration.initial program.program in
  let last (_ : Configuration.t) (t : Transition.t) = t.next in
  { Witness.program = Program_file.header program;
    fleet = Fleet_file.header fleet;
    property = run.breaks;
    steps = steps initial run.steps;
    cycle = steps (List.fold_left last initial run.steps) run.cycle }

let informal_trace (program : Program_file.t) { description; steps; cycle; breaks = _ } =
  let initial = Configuration.initial program.program in
  [ Dolphin_json.Canonical.to_string (Itf.trace program.program ~description initial steps ~cycle) ]

let write program fleet path run =
  Text_file.write path (fun channel ->
      let lines =
        if Filename.check_suffix path ".itf.json" then informal_trace program run
        else Witness.to_lines (witness program fleet run)
      in
      List.iter (fun line -> output_string channel (line ^ "\n")) lines)

(* {1 Pictures} *)

(* The kinds of vehicles; their places do not change, for new ones are not recorded. *)
let tell_fleet (fleet : Fleet_file.t) add =
  let tell state = add (Entry.Vehicle { time = 0.; state }) in
  List.iter tell (World.vehicles (Scenario_world.world fleet.scenario))

let tell_run (program : Program_file.t) (found : Witness.t) transitions add =
  let one (configuration, index) ((step : Witness.step), (t : Transition.t)) =
    let time = float_of_int (index + 1) in
    (match step.cause with Event event -> add (Entry.Event { time; event }) | Choice _ -> ());
    add (Entry.Transition { time; index; step = Step.of_transition program.program configuration t;
                            ways = [] });
    (t.next, index + 1)
  in
  let steps = List.combine (found.steps @ found.cycle) transitions in
  ignore (List.fold_left one (Configuration.initial program.program, 0) steps)

let ending run : Request.ending =
  let repeats =
    match run.cycle with
    | [] -> ""
    | cycle ->
      let first = List.length run.steps + 1 in
      Printf.sprintf "; steps %d to %d repeat without end" first (first + List.length cycle - 1)
  in
  { how = "counterexample"; message = Some (run.description ^ repeats) }

let draw program (fleet : Fleet_file.t) drawing run =
  let summary = Summary.create ~clock:Steps () in
  let add = Summary.add summary in
  add
    (Header
       { program = Program_file.header program; fleet = Fleet_file.header fleet; platform = "sim"; order = By_hearing;
         seed = 0; speed = None; started = ""; run = None;
         fences = Fences.list program.program.fences; place = program.program.place;
         begins = program.program.begins });
  tell_fleet fleet add;
  tell_run program (witness program fleet run) (run.steps @ run.cycle) add;
  let count = List.length run.steps + List.length run.cycle in
  add (End { time = float_of_int count; transitions = count; ending = ending run });
  Drawing.write drawing (Summary.finish summary)

let read path =
  let of_text text =
    let lines = List.filter (fun line -> line <> "") (String.split_on_char '\n' text) in
    Result.map_error (fun why -> Error.Bad_input (Printf.sprintf "%s: %s" path why)) (Witness.of_lines lines)
  in
  Result.bind (Text_file.read path) of_text

let settings path =
  Option.map (fun (found : Witness.t) -> found.program.set) (Result.to_option (read path))
