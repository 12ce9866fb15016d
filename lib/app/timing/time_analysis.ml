module Timed_analysis = Dolphin_time.Timed_analysis
module Scenario_world = Dolphin_environment.Scenario_world

type settings = {
  answers : string list;
  faults : Dolphin_environment.Faults.t;
  deadline : int option;
  workers : int;
  max_states : int option;
  max_depth : int option;
  max_memory : int option;
  timeout : float option;
}

let limits ~interrupted ~progress s =
  Search_limits.make ?max_states:s.max_states ?max_depth:s.max_depth ?max_memory:s.max_memory ?timeout:s.timeout
    ~interrupted ~progress ()

let options s (program : Program_file.t) (fleet : Fleet_file.t) : Dolphin_time.Clocked.options =
  { environment = Scenario_world.environment ~answers:s.answers ~faults:s.faults program.program fleet.scenario;
    program = program.program; world = Scenario_world.world fleet.scenario;
    durations = Dolphin_time.Durations.of_scenario fleet.scenario;
    dates = Dolphin_semantics.Dated_code.named program.program }

let run ?from ~interrupted ~progress s program fleet =
  let { Fleet_file.scenario; _ } = fleet in
  let limits = limits ~interrupted ~progress s and options = options s program fleet in
  match from with
  | None -> Timed_analysis.run ?deadline:s.deadline ~vehicles:scenario.vehicles limits options
  | Some present ->
    let options, start = Present.timed present { options with world = Present.world present scenario } in
    Timed_analysis.run ~start ?deadline:s.deadline limits options

type running = { vehicle : Dolphin_semantics.Core.vehicle; plan : string; ends : Dolphin_time.Bounds.t }

let running ~from s program fleet =
  let options = options s program fleet in
  let later by (bounds : Dolphin_time.Bounds.t) : Dolphin_time.Bounds.t =
    match bounds with
    | Within { least; most } -> Within { least = by + least; most = by + most }
    | (Some_time | Never) as bounds -> bounds
  in
  let of_pending ((p : Dolphin_time.Clocked.pending), began) =
    match p.item, p.task with
    | Task vehicle, Some task ->
      Some { vehicle; plan = task.name; ends = later began p.bounds }
    | _, _ -> None
  in
  List.filter_map of_pending (Present.running from { options with world = Present.world from fleet.scenario })

let slacks ~interrupted ~progress s program fleet =
  Timed_analysis.slacks ~workers:s.workers (limits ~interrupted ~progress s) (options s program fleet)

let duration text =
  let wrong = Error (Printf.sprintf "'%s' is not a time such as 40.min or 90.seconds" text) in
  match Dolphin_syntax.Parse.expression ~file:"time" text with
  | Error _ -> wrong
  | Ok e -> (
      match Dolphin_scenario.Literal.read e with
      | Ok (Number (n, (None | Some Time))) when n >= 0. ->
        Option.to_result (Dolphin_time.Bounds.milliseconds n) ~none:(Printf.sprintf "'%s' is too long" text)
      | Ok (Number _ | Text _ | Position _ | Unknown) | Error _ -> wrong)
