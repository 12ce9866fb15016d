open Dolphin_plans
open Dolphin_semantics
open Dolphin_scenario

let case name run = Alcotest.test_case name `Quick run

let law ?(count = 300) name = Test_support.Property.case ~count name

let scenario source =
  match Scenario.read ~file:"test.fleet" source with
  | Ok s -> s
  | Error faults -> Alcotest.failf "%a" (Fmt.list (Dolphin_syntax.Diagnostic.pp ~source)) faults

let crowd n =
  let vehicle i = Printf.sprintf "vehicle 'v%d', { type 'UUV' }" i in
  scenario (String.concat "\n" (List.init n vehicle))

let task ?plan name =
  { Core.name; plan = Option.map (fun p -> Inline_plan.Maneuvers p) plan; task_site = 0 }

let go_to ?speed ?dwell places =
  let speed = match speed with Some n -> (n, Plan.Metres_per_second) | None -> (1000., Plan.Revolutions_per_minute) in
  let maneuver kind i location =
    { Plan.id = string_of_int i; kind; location; speed; z = (0., Plan.Depth); payloads = [] } in
  let stay =
    match dwell, List.rev places with
    | Some duration, last :: _ ->
      let kind = Plan.Station_keeping { radius = 10.; duration } in
      [ maneuver kind (List.length places) last ]
    | _ -> []
  in
  { Plan.name = "route"; description = ""; vehicles = []; maneuvers = List.mapi (maneuver Plan.Go_to) places @ stay }

let show : Dolphin_runtime.Platform.event -> string = function
  | Vehicle state -> state.id ^ if state.connected then " seen" else " unseen"
  | Task_done v -> v ^ " done"
  | Task_failed (v, why) -> v ^ " failed: " ^ why
  | Timer timer -> Printf.sprintf "timer %d" timer
  | Input (k, _) -> "input " ^ k
  | Quiet -> "quiet"
