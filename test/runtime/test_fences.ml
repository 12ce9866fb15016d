open Dolphin_geo
open Dolphin_plans
open Dolphin_semantics
open Dolphin_runtime
module Mock = Mock_platform
module Platform_of_mock = Fenced.Make (Mock.Paced)

let home = (Mock.vehicle "v1").position
let away metres = Wgs84.move home ~bearing:90. metres
let circle metres = Result.get_ok (Area.circle home metres)

let fence rule : Fences.fence = { rule; margin = 0.; text = "fence"; at = Dolphin_syntax.Location.none }
let within = Fences.make [ fence (Inside (circle 100.)) ]
let apart = Fences.make [ fence (Distance 20.) ]

let go_to metres : Core.platform_task =
  let maneuver : Plan.maneuver =
    { id = "1.Goto"; kind = Go_to; location = away metres; speed = (1., Metres_per_second); z = (0., Depth);
      payloads = [] } in
  let plan : Plan.t = { name = "go"; description = ""; vehicles = []; maneuvers = [ maneuver ] } in
  { name = "go"; plan = Some (Maneuvers plan); task_site = 0 }

let by_name : Core.platform_task = { name = "named"; plan = None; task_site = 0 }
let at time id metres = (time, Platform.Vehicle { (Mock.vehicle id) with position = away metres })

let goes_on events = Mock.make ~fate:(fun _ _ -> Goes_on) events
let fenced fences mock = Platform_of_mock.make (Fence_guard.make fences) ~untold:[] mock
let deadline = 60.
let next p = Lwt_main.run (Lwt_unix.with_timeout deadline (fun () -> Platform_of_mock.next p))

let told : Platform.event -> string = function
  | Vehicle s -> "saw " ^ s.id
  | Task_done v -> "done " ^ v
  | Task_failed (v, why) -> Printf.sprintf "failed %s %s" v (List.hd (String.split_on_char ':' why))
  | Timer _ -> "timer"
  | Input _ -> "input"
  | Quiet -> "quiet"

let tells p expected =
  Alcotest.(check (list string)) "events" expected (List.map (fun _ -> told (next p)) expected)

let asks mock expected = Alcotest.(check (list string)) "commands" expected (Mock.log mock)

let refuses () =
  let mock = goes_on [] in
  let p = fenced within mock in
  let event = Platform_of_mock.next p in
  Alcotest.(check bool) "nothing yet" true (Lwt.state event = Sleep);
  Platform_of_mock.start p ~number:0 "v1" (go_to 150.);
  let event = Lwt_main.run (Lwt_unix.with_timeout deadline (fun () -> event)) in
  Alcotest.(check string) "whoever waits is told" "failed v1 not started" (told event);
  Platform_of_mock.start p ~number:0 "v1" (go_to 50.);
  asks mock [ "0 telemetry true"; "0 start v1 go" ]

let plan_of kind metres : Core.platform_task =
  match go_to metres with
  | { plan = Some (Maneuvers ({ maneuvers = [ m ]; _ } as plan)); _ } as task ->
    { task with plan = Some (Maneuvers { plan with maneuvers = [ { m with kind } ] }) }
  | task -> task

(* A circle takes its room, and so does the way to a plan. *)
let looks_at_all () =
  let loiter radius = plan_of (Loiter { duration = 60.; radius; direction = Clockwise }) 50. in
  let mock = goes_on [ at 0. "v1" (-90.); at 1. "v2" 90. ] in
  let p = fenced (Fences.make [ fence (Inside (circle 100.)) ]) mock in
  Platform_of_mock.start p ~number:0 "v1" (loiter 60.);
  tells p [ "failed v1 not started"; "saw v1"; "saw v2" ];
  Platform_of_mock.start p ~number:0 "v1" (loiter 40.);
  asks mock [ "0 telemetry true"; "1 start v1 go" ];
  let mock = goes_on [ at 0. "v1" (-90.); at 1. "v2" 90. ] in
  let p = fenced (Fences.make [ fence (Outside (circle 30.)) ]) mock in
  tells p [ "saw v1"; "saw v2" ];
  Platform_of_mock.start p ~number:0 "v1" (go_to 60.);
  tells p [ "failed v1 not started" ];
  Platform_of_mock.start p ~number:0 "v2" (go_to 60.);
  asks mock [ "0 telemetry true"; "1 start v2 go" ]

(* A receiver that waits for the platform's events has them, though something was refused meanwhile. *)
let loses_nothing () =
  let mock = Mock.make [] in
  let p = fenced within mock in
  let event = Platform_of_mock.next p in
  Platform_of_mock.start p ~number:0 "v1" (go_to 150.);
  Platform_of_mock.start p ~number:0 "v2" (go_to 50.);
  Alcotest.(check string) "first" "failed v1 not started"
    (told (Lwt_main.run (Lwt_unix.with_timeout deadline (fun () -> event))));
  tells p [ "done v2" ]

let is_overtaken () =
  let mock = Mock.make [] in
  let p = fenced within mock in
  Platform_of_mock.start p ~number:0 "v1" (go_to 150.);
  Platform_of_mock.stop p "v1";
  Platform_of_mock.start p ~number:0 "v1" (go_to 50.);
  tells p [ "done v1" ];
  asks mock [ "0 telemetry true"; "0 start v1 go" ]

let stops () =
  let mock = goes_on [ at 0. "v1" 0.; at 1. "v1" 99.; at 2. "v1" 101.; at 3. "v1" 200. ] in
  let p = fenced within mock in
  tells p [ "saw v1" ];
  Platform_of_mock.start p ~number:0 "v1" by_name;
  tells p [ "saw v1"; "saw v1"; "failed v1 stopped"; "saw v1" ];
  asks mock [ "0 telemetry true"; "0 start v1 named"; "2 stop v1" ]

let ignores_who_rests () =
  let mock = Mock.make ~fate:(fun _ _ -> Succeeds 1.) [ at 0. "v1" 0.; at 5. "v1" 200. ] in
  let p = fenced within mock in
  tells p [ "saw v1" ];
  Platform_of_mock.start p ~number:0 "v1" by_name;
  tells p [ "done v1"; "saw v1" ];
  asks mock [ "0 telemetry true"; "0 start v1 named" ]

let lets_come_back () =
  let mock =
    goes_on [ at 0. "v1" 150.; at 1. "v1" 155.; at 2. "v1" 50.; at 3. "v1" 105.; at 4. "v2" 150.; at 5. "v2" 161. ] in
  let p = fenced within mock in
  tells p [ "saw v1" ];
  Platform_of_mock.start p ~number:0 "v1" (go_to 0.);
  tells p [ "saw v1"; "saw v1"; "saw v1"; "failed v1 stopped"; "saw v2" ];
  Platform_of_mock.start p ~number:0 "v2" by_name;
  tells p [ "saw v2"; "failed v2 stopped" ]

let keeps_apart () =
  let mock = goes_on [ at 0. "v1" 0.; at 1. "v2" 300.; at 2. "v3" 5.; at 3. "v2" 19.; at 4. "v1" 1. ] in
  let p = fenced apart mock in
  tells p [ "saw v1"; "saw v2"; "saw v3" ];
  Platform_of_mock.start p ~number:0 "v1" (go_to 10.);
  Platform_of_mock.start p ~number:0 "v2" (go_to 25.);
  tells p [ "failed v2 not started" ];
  Platform_of_mock.start p ~number:0 "v2" (go_to 40.);
  tells p [ "saw v2"; "failed v1 stopped"; "failed v2 stopped"; "saw v1" ];
  asks mock [ "0 telemetry true"; "2 start v1 go"; "2 start v2 go"; "3 stop v1"; "3 stop v2" ]

(* Depth and height as far as they are reported: a depth, an altitude, or neither. *)
let keeps_to_limits () =
  let limits = Fences.make [ fence (Depth 20.); fence (Height 100.) ] in
  let here = (Mock.vehicle "v1").position in
  let seen ?depth ?altitude time id height =
    (time, Platform.Vehicle { (Mock.vehicle id) with position = { here with height }; depth; altitude }) in
  let mock =
    goes_on
      [ seen 0. "v1" 0.; seen 1. "v1" ~depth:20. 400.; seen 2. "v1" ~depth:20.01 400.; seen 3. "v2" 0.;
        seen 4. "v2" ~altitude:99. 400.; seen 5. "v2" ~altitude:101. 30.; seen 6. "v3" (-90.); seen 7. "v3" 100.;
        seen 8. "v3" 101. ] in
  let p = fenced limits mock in
  Platform_of_mock.start p ~number:0 "v1" by_name;
  Platform_of_mock.start p ~number:0 "v2" by_name;
  Platform_of_mock.start p ~number:0 "v3" by_name;
  tells p
    [ "saw v1"; "saw v1"; "saw v1"; "failed v1 stopped"; "saw v2"; "saw v2"; "saw v2"; "failed v2 stopped"; "saw v3";
      "saw v3"; "saw v3"; "failed v3 stopped" ]

let lets_come_up () =
  let limits = Fences.make [ fence (Inside (circle 100.)); fence (Depth 20.) ] in
  let seen time id depth = (time, Platform.Vehicle { (Mock.vehicle id) with depth = Some depth }) in
  let mock =
    goes_on
      [ seen 0. "v1" 25.; seen 1. "v1" 26.9; seen 2. "v1" 15.; seen 3. "v1" 20.1; seen 4. "v2" 25.; seen 5. "v2" 27.1 ]
  in
  let p = fenced limits mock in
  tells p [ "saw v1" ];
  Platform_of_mock.start p ~number:0 "v1" by_name;
  tells p [ "saw v1"; "saw v1"; "saw v1"; "failed v1 stopped"; "saw v2" ];
  Platform_of_mock.start p ~number:0 "v2" by_name;
  tells p [ "saw v2"; "failed v2 stopped" ]

(* Of several least distances the greatest holds. *)
let keeps_the_greatest () =
  let least distances = Fences.least_distance (Fences.make (List.map (fun d -> fence (Distance d)) distances)) in
  let is_rule expected fence = Option.map (fun (f : Fences.fence) -> f.rule) fence = expected in
  Alcotest.(check bool) "in any order" true
    (List.for_all (fun ds -> is_rule (Some (Fences.Distance 20.)) (least ds)) [ [ 5.; 20. ]; [ 20.; 5. ]; [ 20. ] ]);
  Alcotest.(check bool) "none" true (is_rule None (least []))

let suite =
  [ Alcotest.test_case "a plan beyond a fence is not started" `Quick refuses;
    Alcotest.test_case "circles and ways to a plan take their room" `Quick looks_at_all;
    Alcotest.test_case "no event is lost" `Quick loses_nothing;
    Alcotest.test_case "a stop overtakes a failure" `Quick is_overtaken;
    Alcotest.test_case "who breaks a fence is stopped" `Quick stops;
    Alcotest.test_case "who rests is left alone" `Quick ignores_who_rests;
    Alcotest.test_case "who is beyond a fence may come back" `Quick lets_come_back;
    Alcotest.test_case "who goes too deep or too high is stopped" `Quick keeps_to_limits;
    Alcotest.test_case "who is too deep may come up" `Quick lets_come_up;
    Alcotest.test_case "vehicles under way keep apart" `Quick keeps_apart;
    Alcotest.test_case "the greatest of the least distances holds" `Quick keeps_the_greatest ]
