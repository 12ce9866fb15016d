open Dolphin_semantics
module Scenario = Dolphin_scenario.Scenario
module Environment = Dolphin_explore.Environment

let world scenario =
  let add world (state : World.vehicle_state) = World.add { state with connected = true } world in
  List.fold_left add World.empty (Scenario.states scenario)

let ending (scenario : Scenario.t) v name : Environment.endings =
  let vehicle = List.find_opt (fun (vehicle : Scenario.vehicle) -> vehicle.id = v) scenario.vehicles in
  match Scenario.plan scenario name, vehicle with
  | None, _ -> Succeeds
  | Some plan, Some vehicle when not (Scenario.knows plan vehicle) -> Fails
  | Some plan, _ -> (
      match plan.ending with Succeeds -> Succeeds | May_fail _ -> May_fail | Fails -> Fails)

let answers given (scenario : Scenario.t) prompt =
  match given, List.find_opt (fun (a : Scenario.answer) -> a.prompt = prompt) scenario.answers with
  | _ :: _, _ -> [ given ]
  | [], Some answer -> List.map (fun text -> [ text ]) answer.texts
  | [], None -> []

let environment ~answers:given ~faults scenario =
  let options =
    { Environment.default with endings = ending scenario; answers = answers given scenario }
  in
  match faults with None -> options | Some failures -> Environment.failing ?failures options
