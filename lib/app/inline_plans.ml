open Dolphin_plans
open Dolphin_semantics
open Dolphin_runtime
open Dolphin_scenario
open Dolphin_json
module Simulator = Dolphin_platform_sim.Simulator

type found = {
  name : string;
  plan : Inline_plan.t option;
  from : Dolphin_geo.Position.t;
  speed : float;
  vehicles : Core.vehicle list;
}

(* A run in virtual time is over at once, unless it never is. *)
let most_transitions = 200_000

let started : Effect.t -> (Core.vehicle * Core.platform_task) option = function
  | Start (v, task) -> Some (v, task)
  | Stop _ | Set_timer _ | Cancel_timer _ | Put_question _ | Withdraw_question _ | Look_for _ | Bind _ | Release _
  | Set_connection_timeout _ | Say _ | Ask _ | Call_host _ | End _ -> None

(* The positions and speeds of vehicles, as the run hears them. *)
let observed (fleet : Fleet_file.t) found =
  let positions = Hashtbl.create 16 in
  let speed v =
    match List.find_opt (fun (s : Scenario.vehicle) -> s.id = v) fleet.scenario.vehicles with
    | Some s -> s.speed
    | None -> 1.
  in
  let news ~time:_ (s : World.vehicle_state) = Hashtbl.replace positions s.id s.position in
  let add (v, ({ name; plan; task_site = _ } : Core.platform_task)) =
    let from = Option.value (Hashtbl.find_opt positions v) ~default:Dolphin_geo.Place.apdl in
    let is_it f = f.name = name && f.plan = plan in
    let given f = if is_it f && not (List.mem v f.vehicles) then { f with vehicles = f.vehicles @ [ v ] } else f in
    found :=
      if List.exists is_it !found then List.map given !found
      else { name; plan; from; speed = speed v; vehicles = [ v ] } :: !found
  in
  (news, add)

let of_run (program : Program_file.t) (fleet : Fleet_file.t) ~seed ~answers =
  let found = ref [] and count = ref 0 in
  let enough, stop = Lwt.wait () in
  let news, add = observed fleet found in
  let transition ~time:_ ~cause:_ (t : Transition.t) =
    List.iter add (List.filter_map started t.effects);
    incr count;
    if !count = most_transitions then Lwt.wakeup_later stop ()
  in
  let person = { Questions.nobody with answer = (Console.scripted ~output:ignore ~answers:[] ()).ask } in
  let run =
    Driver.run
      (module Simulator.Virtual)
      (Simulator.Virtual.create ~seed fleet.scenario)
      ~observer:{ Observer.nobody with transition; news }
      ~console:(Questions.console person ~answered:[] ~answers ~scenario:fleet.scenario)
      ~interruption:enough program.program
  in
  let outcome = Lwt_main.run run in
  (List.rev !found, outcome)

let rec to_json definition (plan : Inline_plan.t) =
  match plan with
  | Rest r -> to_json definition r.plan
  | Mission m ->
    Dolphin_platform_protocol.Plan_body.to_json { name = m.name; plan = Some plan; task_site = 0 }
  | Maneuvers p -> (
      let message = Dolphin_imc.Message.Plan_specification (Dolphin_platform_imc.Plan_message.of_plan p) in
      match definition with
      | None -> Dolphin_imc.Message.to_json message
      | Some d -> Dolphin_imc.Dynamic.message_to_json d message)

let broken fences f = Option.bind f.plan (Fences.of_plan fences ~from:(Some f.from))

(* {1 In short} *)

let if_finite x : Yojson.Safe.t = if Float.is_finite x then Canonical.number x else `Null

let maneuver (leg : Inline_plan.leg) : Yojson.Safe.t =
  `Assoc
    [ ("maneuver", `String leg.named); ("points", On_map.path leg.waypoints); ("speed", if_finite leg.speed);
      ("stays", if_finite leg.dwell) ]

let way { from; speed; _ } plan : Yojson.Safe.t =
  let extent = Inline_plan.extent ~from ~speed plan in
  `Assoc
    [ ("from", On_map.pair from); ("metres", if_finite extent.metres);
      ("seconds", if_finite (extent.moving +. extent.staying));
      ("maneuvers", `List (List.map maneuver (Inline_plan.path ~from ~speed plan))) ]

let summary fences found (outcome : Driver.outcome) : Yojson.Safe.t =
  let breach (b : Fences.breach) : Yojson.Safe.t =
    `Assoc [ ("why", `String b.message); ("at", Field.of_option On_map.pair b.place) ] in
  let plan f : Yojson.Safe.t =
    `Assoc
      [ ("plan", `String f.name); ("vehicles", Field.texts f.vehicles); ("way", Field.of_option (way f) f.plan);
        ("breaks", Field.of_option breach (broken fences f)) ] in
  let unfinished =
    match outcome with
    | Ended Completed -> None
    | Ended (Halted _ | Failed _ | Interrupted) | Stuck _ | Spins _ ->
      Some (Format.asprintf "%a" Driver.pp_outcome outcome)
  in
  `Assoc
    [ ("plans", `List (List.map plan found)); ("unfinished", Field.of_option (fun why -> `String why) unfinished) ]
