open Dolphin_imc
open Dolphin_sim_imc

let case name run = Alcotest.test_case name `Quick run
let vehicle = "vehicle 'a', { type 'UUV'; at 41.1850, -8.7060; speed 2 }\n"

let scene ?speed ?strict ?refuses ?blocks ?losses plans =
  let s = Harness.make (Harness.settings ?speed ?strict ?refuses ?blocks ?losses (vehicle ^ plans)) in
  Harness.join s;
  Harness.until s 0.;
  Harness.forget s;
  s

let rec keep_alive s time =
  let next = Float.min time (Harness.now s +. 10.) in
  Harness.until s next;
  if next < time then begin
    Harness.send s Heartbeat;
    keep_alive s time
  end

let summary s = Alcotest.(check (list string)) "summary" s

let replies s =
  List.filter_map
    (fun line -> if String.length line > 6 && String.sub line 0 6 = "reply " then Some line else None)
    (Harness.summary s)

let did s =
  let did a = Yojson.Safe.Util.(to_string (member "did" (Activity.to_json ~time:0. ~vehicle:"a" a))) in
  List.map did (Harness.activities s)

let by_name () =
  let s = scene "plan 'p', { duration 60 }" in
  Harness.start s 7 "p";
  keep_alive s 59.9;
  let begun =
    [ "state INITIALIZING '' - NONE"; "reply SUCCESS START 7 'p' plan loaded"; "vehicle MANEUVER";
      "state EXECUTING 'p' 1 NONE"; "reply SUCCESS START 7 'p' 1: executing maneuver" ]
  in
  summary begun (Harness.summary s);
  keep_alive s 61.;
  summary (begun @ [ "reply SUCCESS START 7 'p' plan completed"; "state READY 'p' - SUCCESS"; "vehicle SERVICE" ])
    (Harness.summary s)

let multiplied () =
  let s = scene ~speed:20. "plan 'p', { duration 60 }" in
  Harness.start s 7 "p";
  Harness.until s 2.9;
  Alcotest.(check (list string)) "under way" [ "started" ] (did s);
  Harness.until s 3.1;
  Alcotest.(check (list string)) "over in a twentieth" [ "started"; "completed" ] (did s)

let progress () =
  let s = scene "plan 'p', { duration 100 }" in
  Harness.start s 7 "p";
  keep_alive s 50.1;
  let state = List.fold_left (fun last (h : Harness.heard) ->
      match h.packet.content with Message (Plan_control_state s) -> Some s | Message _ | Unknown _ -> last)
      None (Harness.heard s) in
  match state with
  | Some state ->
    Alcotest.(check bool) "half done" true (Float.abs (state.plan_progress -. 50.) < 1.);
    Alcotest.(check bool) "half to go" true (abs (state.plan_eta - 50) <= 1)
  | None -> Alcotest.fail "no state"

let twice () =
  let s = scene "plan 'p', { duration 60 }" in
  Harness.start s 7 "p";
  Harness.until s 5.;
  Harness.start s 7 "p";
  Harness.until s 6.;
  Alcotest.(check (list string)) "starts again" [ "started"; "started" ] (did s);
  match List.rev (Harness.activities s) with
  | Started { instead = Some "p"; _ } :: _ -> ()
  | _ -> Alcotest.fail "not instead of itself"

let fails () =
  let s = scene "plan 'p', { duration 10; fails }" in
  Harness.start s 7 "p";
  keep_alive s 11.;
  Alcotest.(check (list string)) "with a text" 
    [ "reply SUCCESS START 7 'p' plan loaded"; "reply SUCCESS START 7 'p' 1: executing maneuver";
      "reply FAILURE START 7 'p' plan failed" ]
    (replies s);
  Alcotest.(check bool) "outcome" true (List.mem "state READY 'p' - FAILURE" (Harness.summary s));
  Alcotest.(check (list string)) "activities" [ "started"; "failed" ] (did s)

let refusals () =
  let refusal ?strict ?refuses plans plan =
    let s = scene ?strict ?refuses plans in
    Harness.start s 7 plan;
    Harness.summary s
  in
  let refused ?(plan = "p") why =
    [ "state INITIALIZING '' - NONE"; Printf.sprintf "reply FAILURE START 7 '%s' %s" plan why;
      "state READY '' - FAILURE" ]
  in
  summary (refused "undefined plan") (refusal ~strict:true "" "p");
  summary (refused "undefined plan") (refusal "plan 'p', { only 'UAV' }" "p");
  summary (refused ~plan:"" "undefined plan id") (refusal "" "");
  summary (refused "out of order") (refusal ~refuses:"out of order" "" "p");
  summary [] (refusal "" "dislodge")

let without_entry () =
  let s = scene "" in
  Harness.start s 7 "anything";
  keep_alive s 181.;
  Alcotest.(check (list string)) "as long as any plan" [ "started"; "completed" ] (did s)

let stops () =
  let s = scene "" in
  Harness.stop s 8;
  summary [ "reply FAILURE STOP 8 '' no plan is running, request ignored" ] (Harness.summary s)

let calibrates () =
  let s = scene "plan 'p', { duration 10 }" in
  Harness.start ~flags:Message.Plan_control.Flags.calibrate s 7 "p";
  Harness.until s 2.9;
  summary [ "state INITIALIZING '' - NONE"; "reply SUCCESS START 7 'p' plan loaded"; "vehicle CALIBRATION" ]
    (Harness.summary s);
  Harness.until s 12.9;
  Alcotest.(check (list string)) "not done" [ "started" ] (did s);
  Harness.until s 13.1;
  Alcotest.(check (list string)) "done" [ "started"; "completed" ] (did s)

let blocked () =
  let s = scene ~blocks:[ 5., 10. ] "plan 'p', { duration 60 }" in
  Harness.start s 7 "p";
  Harness.until s 6.;
  Harness.start s 8 "p";
  Harness.until s 16.;
  let rec from_block = function ("reply FAILURE START 7 'p' vehicle is under external control" :: _) as rest -> rest
                              | _ :: rest -> from_block rest | [] -> [] in
  summary
    [ "reply FAILURE START 7 'p' vehicle is under external control"; "state BLOCKED 'p' - FAILURE"; "vehicle EXTERNAL";
      "reply FAILURE START 8 'p' vehicle is blocked"; "vehicle SERVICE"; "state READY 'p' - FAILURE" ]
    (from_block (Harness.summary s));
  Alcotest.(check (list string)) "activities" [ "started"; "blocked"; "refused"; "unblocked" ] (did s)

let lost () =
  let s = scene ~losses:[ 5. ] "plan 'p', { duration 60 }" in
  Harness.start s 7 "p";
  Harness.until s 4.;
  Harness.forget s;
  Harness.until s 6.;
  Harness.stop s 8;
  Harness.start s 9 "p";
  Harness.until s 7.;
  Harness.send s Abort;
  Harness.until s 9.;
  let from_loss =
    List.filter (fun line -> line <> "vehicle MANEUVER" && line <> "state EXECUTING 'p' 1 NONE") (Harness.summary s)
  in
  summary
    [ "state BLOCKED 'p' - FAILURE"; "reply FAILURE STOP 8 '' no plan is running, request ignored";
      "reply FAILURE START 9 'p' vehicle is blocked"; "vehicle ERROR"; "vehicle SERVICE"; "state READY 'p' - FAILURE" ]
    from_loss;
  Alcotest.(check (list string)) "activities" [ "lost"; "stopped"; "refused"; "aborted"; "unblocked" ] (did s)

let aborted_at_rest () =
  let s = scene "" in
  Harness.send s Abort;
  Harness.until s 2.;
  summary
    [ "state BLOCKED '' - NONE"; "vehicle ERROR"; "vehicle SERVICE"; "state READY '' - NONE" ]
    (List.filter (fun l -> l <> "") (Harness.summary s))

(* {1 Inline plans} *)

let go_to north : Message.Maneuver.t =
  let p = Dolphin_geo.Wgs84.displace { latitude = 41.1850; longitude = -8.7060; height = 0. } ~north ~east:0. in
  let lat = Dolphin_geo.Angle.radians p.latitude and lon = Dolphin_geo.Angle.radians p.longitude in
  Goto { Message.Goto.default with lat; lon; speed = 2.; speed_units = Meters_ps }

let maneuver id data = { Message.Plan_maneuver.default with maneuver_id = id; data = Some data }
let transition source_man dest_man = { Message.Plan_transition.default with source_man; dest_man }

let specification ?(start = "1") maneuvers transitions =
  { Message.Plan_specification.default with plan_id = "p"; start_man_id = start; maneuvers; transitions }

let inline () =
  let s = scene "" in
  let plan =
    specification [ maneuver "1" (go_to 20.); maneuver "2" (go_to 60.) ] [ transition "1" "2"; transition "2" "_done_" ]
  in
  Harness.start ~arg:(Plan_specification plan) s 7 "p";
  Harness.until s 15.;
  let states = List.filter (fun l -> String.sub l 0 5 = "state") (Harness.summary s) in
  summary [ "state INITIALIZING '' - NONE"; "state EXECUTING 'p' 1 NONE"; "state EXECUTING 'p' 2 NONE" ] states;
  Harness.until s 31.;
  Alcotest.(check (list string)) "as long as its way takes" [ "started"; "completed" ] (did s);
  let there = Vehicle_node.position ~at:31. (Harness.node s) in
  let start : Dolphin_geo.Position.t = { latitude = 41.1850; longitude = -8.7060; height = 0. } in
  Alcotest.(check (float 0.5)) "is there" 60. (Dolphin_geo.Wgs84.distance start there);
  Harness.start s 8 "p";
  Alcotest.(check (list string)) "is known by name from then on" [ "started"; "completed"; "started" ] (did s)

let one_maneuver () =
  let s = scene "" in
  Harness.start ~arg:(Maneuver (go_to 20.)) s 7 "p";
  Harness.until s 11.;
  Alcotest.(check (list string)) "is a plan" [ "started"; "completed" ] (did s)

let read () =
  let check name expected plan =
    let got =
      match Specification.read plan with
      | Ok s -> Ok (List.map (fun (m : Dolphin_plans.Plan.maneuver) -> m.id) s.plan.maneuvers)
      | Error why -> Error why
    in
    Alcotest.(check (result (list string) string)) name expected got
  in
  let m id = maneuver id (go_to 1.) in
  check "first transition only" (Ok [ "1"; "3" ])
    (specification [ m "1"; m "2"; m "3" ] [ transition "1" "3"; transition "1" "2" ]);
  check "a circle ends by keeping station" (Ok [ "1"; "2"; "1" ])
    (specification [ m "1"; m "2" ] [ transition "1" "2"; transition "2" "1" ]);
  check "no way to it" (Error "parse error: 2: has no incoming transition and it's not the initial maneuver")
    (specification [ m "1"; m "2" ] []);
  check "not supported" (Error "parse error: 2: maneuver is not supported")
    (specification [ m "1"; maneuver "2" Image_tracking ] [ transition "1" "2" ]);
  check "too deep" (Error "parse error: 1: maneuver depth beyond limits")
    (specification [ maneuver "1" (Goto { Message.Goto.default with z = 101.; z_units = Depth }) ] []);
  check "rows without end" (Error "parse error: 1: maneuver has invalid parameters")
    (specification [ maneuver "1" (Rows { Message.Rows.default with width = 1e6; hstep = 1e-6 }) ] []);
  check "nowhere" (Error "parse error: 1: maneuver has invalid coordinates")
    (specification [ maneuver "1" (Goto { Message.Goto.default with lat = nan }) ] [])

let tests =
  [ case "runs a plan that it knows" by_name;
    case "runs missions faster" multiplied;
    case "tells the progress" progress;
    case "starts again when told twice" twice;
    case "fails as the scenario says" fails;
    case "refuses, in its own words" refusals;
    case "runs plans that nobody has described" without_entry;
    case "cannot stop what is not running" stops;
    case "calibrates first" calibrates;
    case "is blocked for a while" blocked;
    case "loses its plan and goes on" lost;
    case "is aborted at rest" aborted_at_rest;
    case "flies the maneuvers of an inline plan" inline;
    case "flies one maneuver" one_maneuver;
    case "reads specifications as a vehicle does" read ]
