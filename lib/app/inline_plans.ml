open Dolphin_semantics
open Dolphin_runtime
module Simulator = Dolphin_platform_sim.Simulator

type found = { name : string; plan : Inline_plan.t option }

(* A run in virtual time is over at once, unless it never is. *)
let most_transitions = 200_000

let started : Effect.t -> found option = function
  | Start (_, { name; plan; _ }) -> Some { name; plan }
  | Stop _ | Set_timer _ | Cancel_timer _ | Look_for _ | Bind _ | Release _ | Set_connection_timeout _ | Say _ | Ask _
  | Call_host _ | End _ -> None

let of_run (program : Program_file.t) (fleet : Fleet_file.t) ~seed ~answers =
  let found = ref [] and count = ref 0 in
  let enough, stop = Lwt.wait () in
  let add plan = if not (List.mem plan !found) then found := plan :: !found in
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
      ~observer:{ Observer.nobody with transition }
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
