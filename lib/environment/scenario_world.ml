open Dolphin_plans
open Dolphin_semantics
module Scenario = Dolphin_scenario.Scenario
module Open_sensors = Dolphin_scenario.Open_sensors

let still scenario =
  let add world (state : World.vehicle_state) = World.add { state with connected = true } world in
  List.fold_left add World.empty (Scenario.states scenario)

let world (scenario : Scenario.t) =
  World.at Any (List.fold_left Open_sensors.of_entry (still scenario) scenario.vehicles)

let seen scenario known =
  let add world (s : World.vehicle_state) =
    let is_new = World.find s.id world = None in
    let world = World.add { s with connected = true; unready = None } world in
    let open_reading world (name, _) = World.open_sensor (Measurement name) s.id [] world in
    if not is_new then world
    else List.fold_left open_reading (Open_sensors.of_vehicle s.id ~places:[] ~batteries:[] world) s.readings
  in
  List.fold_left add (world scenario) (World.vehicles known)

(* From the start on its battery lets it do no work that takes time. *)
let is_empty (v : Scenario.vehicle) = v.battery <= 0. && v.drain > 0.

let may_be_charged (scenario : Scenario.t) (v : Scenario.vehicle) =
  v.charge > 0. || List.exists (fun (p : Scenario.plan) -> p.charges <> None) scenario.plans

(* The ending of a plan given to a vehicle with an empty battery: plans without duration succeed. *)
let ending_when_empty scenario vehicle (plan : Scenario.plan option) : Environment.ending =
  match plan with
  | Some { duration = Some { most; _ }; ending = Succeeds; _ } when most <= 0. -> Succeeds
  | Some { duration = Some { least; _ }; _ } when least > 0. && not (may_be_charged scenario vehicle) -> Fails
  | Some { ending = Fails; _ } -> Fails
  | Some _ | None -> May_fail

(* It is asked of each task of each state, so vehicles are found by a table. *)
let ending (scenario : Scenario.t) =
  let vehicles = Hashtbl.create 16 in
  List.iter (fun (vehicle : Scenario.vehicle) -> Hashtbl.replace vehicles vehicle.id vehicle) scenario.vehicles;
  fun v name : Environment.ending ->
    match Scenario.plan scenario name, Hashtbl.find_opt vehicles v with
    | Some plan, Some vehicle when not (Scenario.knows plan vehicle) -> Fails
    | plan, Some vehicle when is_empty vehicle -> ending_when_empty scenario vehicle plan
    | None, _ -> Succeeds
    | Some plan, _ -> (
        match plan.ending with Succeeds -> Succeeds | May_fail _ -> May_fail | Fails -> Fails)

let answers given (scenario : Scenario.t) prompt =
  match given, List.find_opt (fun (a : Scenario.answer) -> a.prompt = prompt) scenario.answers with
  | _ :: _, _ -> [ given ]
  | [], Some answer -> List.map (fun text -> [ text ]) answer.texts
  | [], None -> []

let is_unsteady (v : Scenario.vehicle) = v.joins > 0. || v.leaves <> None || v.drops <> []

let input (i : Scenario.input) : Environment.input =
  { key = i.key; rounds = i.rounds; times = i.times; certain = i.after <> None }

(* A task that is not started, or stopped, because it breaks a fence is to the program a task that fails. The
   affected plans depend on the vehicles' places. *)
let ending_within (fences : Fences.t) (scenario : Scenario.t) =
  let ending = ending scenario in
  fun v name : Environment.ending ->
    match ending v name with
    | Succeeds when not (Fences.is_none fences && scenario.fences = []) -> May_fail
    | (Succeeds | May_fail | Fails) as ending -> ending

let environment ~answers:given ~faults (program : Core.program) (scenario : Scenario.t) =
  let unsteady = List.filter is_unsteady scenario.vehicles in
  let late = List.map (fun (v : Scenario.vehicle) -> v.id) (if unsteady = [] then scenario.vehicles else unsteady) in
  {
    Environment.endings = ending_within program.fences scenario;
    plans = List.map (fun (p : Scenario.plan) -> p.name) scenario.plans;
    may_be_late = (fun v -> List.mem v late);
    answers = answers given scenario;
    replies = (fun call -> Option.value (Scenario.rounds scenario call) ~default:[]);
    inputs = List.map input scenario.inputs;
    faults;
    most_faults = None;
    who_is_lost_matters = true;
    recurring = List.map (fun (r : Scenario.recurrence) -> r.readings) scenario.recurrences;
  }
