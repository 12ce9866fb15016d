open Dolphin_semantics
open Dolphin_runtime
open Dolphin_scenario
module Simulator = Dolphin_platform_sim.Simulator

type found = { name : string; plan : Inline_plan.t option; from : Dolphin_geo.Position.t; speed : float }

(* A run in virtual time is over at once, unless it never is. *)
let most_transitions = 200_000

let started : Effect.t -> (Core.vehicle * Core.platform_task) option = function
  | Start (v, task) -> Some (v, task)
  | Stop _ | Set_timer _ | Cancel_timer _ | Put_question _ | Withdraw_question _ | Look_for _ | Bind _ | Release _
  | Set_connection_timeout _ | Say _ | Ask _ | Call_host _ | End _ -> None

(* Where vehicles are, as the run hears it, and how fast they go. *)
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
    if not (List.exists (fun f -> f.name = name && f.plan = plan) !found) then
      found := { name; plan; from; speed = speed v } :: !found
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

let to_json definition (plan : Inline_plan.t) =
  match plan with
  | Mission m ->
    Dolphin_platform_protocol.Plan_body.to_json { name = m.name; plan = Some plan; task_site = 0 }
  | Maneuvers p -> (
      let message = Dolphin_imc.Message.Plan_specification (Dolphin_platform_imc.Plan_message.of_plan p) in
      match definition with
      | None -> Dolphin_imc.Message.to_json message
      | Some d -> Dolphin_imc.Dynamic.message_to_json d message)
