module Model = Dolphin_tla.Model
module Scenario = Dolphin_scenario.Scenario
module Scenario_world = Dolphin_environment.Scenario_world

type t = {
  files : Model.file list;
  environment : Dolphin_environment.Environment.options;
  world : Dolphin_semantics.World.t;
}

let calls (fleet : Fleet_file.t) = List.map (fun (reply : Scenario.reply) -> reply.call) fleet.scenario.replies

let unfit_replies (program : Program_file.t) (fleet : Fleet_file.t) ~environment ~world =
  let named = Scenario.replies_at ~file:(Option.value fleet.path ~default:"") fleet.source in
  let refusal (call, why) = Dolphin_syntax.Diagnostic.error (List.assoc call named) why in
  List.map refusal (Model.unfit_replies ~environment ~calls:(calls fleet) world program.program)

(* The number of ticks that are explored: a run may go on without end. *)
let horizon = 1_000

let times ~tick ~faults ~plans program scenario world : Dolphin_tla.Times.t =
  let durations = Dolphin_time.Durations.of_scenario scenario in
  let usual () = Dolphin_tla.Times.tick durations ~faults ~plans program world in
  let tick = match tick with Some tick -> tick | None -> usual () in
  { durations; tick; horizon }

let make ?tick ~answers ~faults (program : Program_file.t) (fleet : Fleet_file.t) =
  let scenario = fleet.scenario in
  let environment = Scenario_world.environment ~answers ~faults program.program scenario in
  let world = Scenario_world.world scenario in
  let plans = List.map (fun (plan : Scenario.plan) -> plan.name) scenario.plans in
  let prompts = List.map (fun (answer : Scenario.answer) -> answer.prompt) scenario.answers in
  match unfit_replies program fleet ~environment ~world with
  | _ :: _ as found -> Error (Error.Bad_text { source = fleet.source; found })
  | [] -> (
      let times = times ~tick ~faults ~plans program.program scenario world in
      match Model.of_program ~times ~plans ~prompts ~calls:(calls fleet) ~environment world program.program with
      | Ok files -> Ok { files; environment; world }
      | Error found -> Error (Error.Bad_text { source = program.source; found }))
