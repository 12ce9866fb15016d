open Dolphin_plans
open Dolphin_semantics
open Core
open Writing
module Position = Dolphin_geo.Position
module Place = Dolphin_geo.Place
module Wgs84 = Dolphin_geo.Wgs84

let maneuvers settings = (built settings).maneuvers

let only settings =
  match maneuvers settings with
  | [ m ] -> m
  | ms -> Alcotest.failf "%d maneuvers where there should be one" (List.length ms)

(* {1 Comparing} *)

let position = Alcotest.testable Position.pp Position.equal
let ids settings = List.map (fun (m : Plan.maneuver) -> m.id) (maneuvers settings)

let same what expected found = Alcotest.(check bool) what true (expected = found)

let kind_is what expected settings = same what expected (only settings).kind
let speed_is what expected settings = same what (expected : float * Plan.speed_unit) (only settings).speed
let z_is what expected settings = same what (expected : float * Plan.z_unit) (only settings).z

let payloads settings =
  List.map (fun (d : Plan.payload) -> (d.name, d.parameters)) (only settings).payloads

let parameters = Alcotest.(list (pair string (list (pair string string))))

(* {1 The paper's plan} *)

let figure_8 () =
  let plan =
    built
      [ set "planName" [ str "waterSurvey" ];
        set "speed" [ n 1.5; sym "Speed.Units.METERS_PS" ];
        set "z" [ n 0.; sym "Z.Units.DEPTH" ];
        set "locate" [ Position Place.apdl ];
        set "move" [ i 30; i (-125) ];
        man "goTo" [ ("payload", items [ Map [ ("name", str "Camera") ] ]) ];
        set "move" [ i (-30); i (-50) ];
        man "loiter" [ ("radius", i 100) ] ]
  in
  let first = Wgs84.displace Place.apdl ~north:30. ~east:(-125.) in
  let second = Wgs84.displace first ~north:(-30.) ~east:(-50.) in
  let speed = (1.5, Plan.Metres_per_second) and z = (0., Plan.Depth) in
  let camera = { Plan.name = "Camera"; parameters = [ ("Active", "true") ] } in
  same "the plan"
    {
      Plan.name = "waterSurvey";
      description = "";
      vehicles = [];
      maneuvers =
        [ { id = "1.Goto"; kind = Go_to; location = first; speed; z; payloads = [ camera ] };
          {
            id = "2.Loiter";
            kind = Loiter { radius = 100.; duration = 60.; direction = Vehicle_dependent };
            location = second;
            speed;
            z;
            payloads = [];
          } ];
    }
    plan;
  Alcotest.(check (list string)) "required payload" [ "Camera" ] (Plan.required_payload plan);
  Alcotest.(check (option position)) "reference" (Some first) (Plan.reference plan)

(* {1 Settings} *)

let plan_defaults () =
  let plan = built [ go ] in
  Alcotest.(check string) "name" "p" plan.name;
  Alcotest.(check string) "description" "" plan.description;
  Alcotest.(check (list string)) "vehicles" [] plan.vehicles;
  let m = only [ go ] in
  Alcotest.(check string) "id" "1.Goto" m.id;
  Alcotest.check position "location" Place.apdl m.location;
  same "speed" (900., Plan.Revolutions_per_minute) m.speed;
  same "z" (2., Plan.Depth) m.z;
  same "payload" [] m.payloads

let names () =
  let plan =
    built
      [ set "planName" [ str "a" ];
        set "planName" [ str "b" ];
        set "description" [ str "seen twice" ];
        set "vehicles" [ str "y"; items [ str "x"; str "y" ]; Vehicles [ "w"; "x" ] ];
        go ]
  in
  Alcotest.(check string) "the last name" "b" plan.name;
  Alcotest.(check string) "description" "seen twice" plan.description;
  Alcotest.(check (list string)) "each vehicle once" [ "y"; "x"; "w" ] plan.vehicles

let speeds () =
  let after xs = [ set "speed" xs; go ] in
  speed_is "m/s" (1.5, Metres_per_second) (after [ n 1.5; sym "Speed.Units.METERS_PS" ]);
  speed_is "rpm" (1200., Revolutions_per_minute) (after [ i 1200; sym "Speed.Units.RPM" ]);
  speed_is "percent" (80., Percent) (after [ i 80; sym "Speed.Units.PERCENTAGE" ]);
  speed_is "last two names" (2., Metres_per_second) (after [ i 2; sym "Units.METERS_PS" ]);
  speed_is "a string" (1000., Revolutions_per_minute) (after [ i 1000; str "rpm" ]);
  speed_is "as a list" (1000., Revolutions_per_minute) (after [ items [ i 1000; str "rpm" ] ]);
  speed_is "first without unit" (1.5, Metres_per_second) (after [ n 1.5 ]);
  speed_is "the unit before" (1000., Revolutions_per_minute)
    [ set "speed" [ i 900; sym "Speed.Units.RPM" ]; set "speed" [ i 1000 ]; go ]

let depths () =
  let after xs = [ set "z" xs; go ] in
  z_is "without unit" (5., Depth) (after [ i 5 ]);
  z_is "depth" (5., Depth) (after [ i 5; sym "Z.Units.DEPTH" ]);
  z_is "altitude" (3., Altitude) (after [ i 3; sym "Z.Units.ALTITUDE" ]);
  z_is "height" (-2., Height) (after [ i (-2); sym "Z.Units.HEIGHT" ]);
  z_is "none" (0., Unspecified) (after [ i 0; sym "Z.Units.NONE" ]);
  z_is "the unit before" (120., Height) [ set "z" [ i 100; sym "Z.Units.HEIGHT" ]; set "z" [ i 120 ]; go ]

let locations () =
  let located xs = (only [ set "locate" xs; go ]).location in
  let here : Position.t = { latitude = 41.5; longitude = -8.25; height = 0. } in
  Alcotest.check position "a position" Place.feup (located [ Position Place.feup ]);
  Alcotest.check position "degrees" here (located [ n 41.5; n (-8.25) ]);
  Alcotest.check position "a list" here (located [ items [ n 41.5; n (-8.25) ] ]);
  let moved = Wgs84.displace Place.apdl ~north:100. ~east:0. in
  Alcotest.check position "moves add up"
    (Wgs84.displace moved ~north:0. ~east:(-20.))
    (only [ set "move" [ i 100; i 0 ]; set "move" [ i 0; n (-20.) ]; go ]).location

let arguments_hold_on () =
  match
    maneuvers
      [ man "goTo"
          [ ("speed", items [ i 2; sym "Speed.Units.METERS_PS" ]); ("z", i 7); ("location", Position Place.feup) ];
        man "loiter" [];
        set "move" [ i 10; i 0 ];
        man "launch" [ ("speed", i 3) ] ]
  with
  | [ first; second; third ] ->
    List.iter
      (fun (m : Plan.maneuver) ->
         Alcotest.check position m.id Place.feup m.location;
         same "speed" (2., Plan.Metres_per_second) m.speed;
         same "z" (7., Plan.Depth) m.z)
      [ first; second ];
    Alcotest.check position "moved from there" (Wgs84.displace Place.feup ~north:10. ~east:0.) third.location;
    same "the unit before" (3., Plan.Metres_per_second) third.speed
  | _ -> Alcotest.fail "not three maneuvers"

(* {1 Maneuvers} *)

let simple_maneuvers () =
  kind_is "goTo" Plan.Go_to [ go ];
  kind_is "arguments as a map" Plan.Launch [ set "launch" [ Map [ ("speed", i 2) ] ] ];
  kind_is "launch" Plan.Launch [ man "launch" [] ]

let loiters () =
  kind_is "defaults" (Plan.Loiter { radius = 20.; duration = 60.; direction = Vehicle_dependent }) [ man "loiter" [] ];
  kind_is "arguments"
    (Plan.Loiter { radius = 100.; duration = 300.; direction = Clockwise })
    [ man "loiter" [ ("radius", i 100); ("duration", n (2.3 *. 60. +. 162.)); ("direction", str "clockw") ] ]

let yoyos () =
  kind_is "defaults" (Plan.Yo_yo { amplitude = 18.; pitch = 15. }) [ man "yoyo" [] ];
  z_is "half-way, whatever z was" (11., Depth) [ set "z" [ i 3; sym "Z.Units.ALTITUDE" ]; man "yoyo" [] ];
  let own = [ man "yoyo" [ ("max_depth", i 10); ("min_depth", i 0); ("pitch", i 20) ] ] in
  kind_is "arguments" (Plan.Yo_yo { amplitude = 10.; pitch = 20. }) own;
  z_is "half-way" (5., Depth) own;
  match maneuvers [ man "yoyo" []; go ] with
  | [ _; next ] -> same "the next one's z" (2., Plan.Depth) next.z
  | _ -> Alcotest.fail "not two maneuvers"

let pop_ups () =
  let pop_up duration current_position wait_at_surface station_keep =
    Plan.Pop_up { duration; current_position; wait_at_surface; station_keep }
  in
  kind_is "defaults" (pop_up 180. true false false) [ man "popup" [] ];
  kind_is "at a location" (pop_up 180. false false false) [ man "popup" [ ("location", Position Place.feup) ] ];
  kind_is "arguments" (pop_up 60. false true true)
    [ man "popup"
        [ ("duration", i 60); ("currPos", Boolean false); ("waitAtSurface", Boolean true);
          ("stationKeep", Boolean true) ] ]

let station_keepings () =
  kind_is "defaults" (Plan.Station_keeping { radius = 20.; duration = 60. }) [ man "skeeping" [] ];
  kind_is "arguments, without end"
    (Plan.Station_keeping { radius = 5.; duration = 0. })
    [ man "skeeping" [ ("radius", i 5); ("duration", i 0) ] ]

let compass_calibrations () =
  kind_is "defaults"
    (Plan.Compass_calibration { amplitude = 1.; radius = 5.; pitch = 15.; duration = 300.; direction = Clockwise })
    [ man "compassCalibration" [] ];
  kind_is "arguments"
    (Plan.Compass_calibration
       { amplitude = 2.; radius = 8.; pitch = -10.; duration = 30.; direction = Into_wind_or_current })
    [ man "compassCalibration"
        [ ("amplitude", i 2); ("radius", i 8); ("pitch", i (-10)); ("duration", i 30);
          ("direction", str "IWINDCURR") ] ]

let default_rows : Plan.kind =
  Rows
    {
      bearing = 0.;
      cross_angle = 0.;
      width = 100.;
      length = 200.;
      horizontal_step = 27.;
      curve_offset = 15.;
      alternation = 100.;
      square_curve = true;
      first_curve_right = false;
    }

let all_rows () =
  kind_is "defaults" default_rows [ man "rows" [] ];
  kind_is "a whole turn is none" default_rows [ man "rows" [ ("bearing", i 360) ] ];
  kind_is "arguments"
    (Rows
       {
         bearing = 315.;
         cross_angle = 10.;
         width = 50.;
         length = 80.;
         horizontal_step = 12.5;
         curve_offset = 20.;
         alternation = 50.;
         square_curve = false;
         first_curve_right = true;
       })
    [ man "rows"
        [ ("bearing", i (-45)); ("cross_angle", i 10); ("width", i 50); ("length", i 80); ("hstep", n 12.5);
          ("coff", i 20); ("alternation", i 50); ("squareCurve", Boolean false);
          ("firstCurveRight", Boolean true) ] ];
  let offset named =
    match (only [ man "rows" named ]).kind with Rows r -> r.curve_offset | _ -> Alcotest.fail "not rows"
  in
  Alcotest.(check (float 0.)) "curvOff" 8. (offset [ ("curvOff", i 8) ]);
  Alcotest.(check (float 0.)) "coff before curvOff" 9. (offset [ ("coff", i 9); ("curvOff", i 8) ])

let paths () =
  kind_is "lists and maps"
    (Plan.Follow_path [ (0., 0., 0.); (10., -20., 3.); (5., 6., 0.); (7., 8., -1.) ])
    [ man "followPath"
        [ ( "points",
            items
              [ items [ i 0; i 0 ];
                items [ i 10; i (-20); n 3. ];
                Map [ ("east", i 6); ("north", i 5) ];
                Map [ ("north", i 7); ("east", i 8); ("down", i (-1)) ] ] ) ] ];
  let there = Wgs84.displace Place.feup ~north:300. ~east:400. in
  match
    (only
       [ man "followPath" [ ("points", items [ Position there ]); ("location", Position Place.feup) ] ])
    .kind
  with
  | Follow_path [ (north, east, down) ] ->
    Alcotest.(check (list (float 1e-3))) "a position" [ 300.; 400.; 0. ] [ north; east; down ]
  | _ -> Alcotest.fail "not one point"

let identifiers () =
  let all =
    [ go; man "loiter" []; man "yoyo" []; man "popup" []; man "skeeping" []; man "compassCalibration" [];
      man "launch" []; man "rows" [];
      man "followPath" [ ("points", items [ items [ i 1; i 2 ] ]) ] ]
  in
  Alcotest.(check (list string))
    "numbers and messages"
    [ "1.Goto"; "2.Loiter"; "3.YoYo"; "4.PopUp"; "5.StationKeeping"; "6.CompassCalibration"; "7.Launch"; "8.Rows";
      "9.FollowPath" ]
    (ids all);
  Alcotest.(check (list string))
    "given ones count, and are kept free"
    [ "1.Goto.2"; "3.Loiter"; "3.Loiter.2"; "1.Goto" ]
    (ids [ go; man "goTo" [ ("id", str "3.Loiter") ]; man "loiter" []; man "loiter" [ ("id", str "1.Goto") ] ])

let payload () =
  let found x = payloads [ man "goTo" [ ("payload", x) ] ] in
  let check = Alcotest.check parameters in
  check "a list of maps"
    [ ("Camera", [ ("Active", "true"); ("Frequency", "50") ]); ("DVL", [ ("Active", "true") ]) ]
    (found (items [ Map [ ("name", str "Camera"); ("Frequency", i 50) ]; Map [ ("name", str "DVL") ] ]));
  check "a map; words capitalised; values as text"
    [ ( "Side Scan",
        [ ("Active", "true"); ("High-frequency Channels", "Both"); ("Range", "50"); ("Gain", "0.5"); ("Log", "true") ]
      ) ]
    (found
       (Map
          [ ("high-frequency  channels", str "Both"); ("name", str "side scan"); ("range", n 50.); ("Gain", n 0.5);
            ("log", Boolean true) ]));
  check "names alone" [ ("Camera", [ ("Active", "true") ]) ] (found (items [ str "camera" ]));
  check "one name" [ ("Camera", [ ("Active", "true") ]) ] (found (str "Camera"));
  check "switched off"
    [ ("Camera", [ ("Active", "false"); ("Rate", "2") ]) ]
    (found (Map [ ("name", str "Camera"); ("rate", i 2); ("active", Boolean false) ]))

(* {1 Plans without a place} *)

let unplaced () =
  let is_built settings = Result.is_ok (build ~place:None settings) in
  let off = man "popup" [ ("currPos", Boolean false) ] and up = man "popup" [] in
  let at = ("location", Position Place.feup) and points = ("points", items [ items [ i 1; i 2 ] ]) in
  let all = [ "goTo"; "loiter"; "yoyo"; "skeeping"; "compassCalibration"; "launch"; "rows"; "followPath" ] in
  let refuses setting =
    let own = if setting = "followPath" then [ points ] else [] in
    let expected = "'" ^ setting ^ "' has no place: neither plan, program nor fleet has one; " ^ Plan_builder.hint_for_place in
    (match build ~place:None [ up; man setting own ] with
     | Ok _ -> Alcotest.failf "%s needs no place" setting
     | Error fault -> Alcotest.(check (pair int string)) setting (1, expected) (fault.site, fault.message));
    Alcotest.(check bool) (setting ^ " with a location") true (is_built [ up; man setting (at :: own) ]);
    Alcotest.(check bool) (setting ^ " after one") true (is_built [ set "locate" [ i 41; i (-8) ]; man setting own ])
  in
  List.iter refuses all;
  Alcotest.(check bool) "popup where the vehicle is" true (is_built [ up ]);
  Alcotest.(check bool) "popup elsewhere" false (is_built [ off ]);
  Alcotest.(check bool) "move" false (is_built [ set "move" [ i 1; i 2 ]; up ]);
  Alcotest.(check (option position)) "nowhere" None
    (Option.bind (Result.to_option (build ~place:None [ up ])) Plan.reference)

(* {1 What is exported} *)

let vocabulary () =
  let common = [ "speed"; "z"; "location"; "id"; "payload" ] in
  let arguments name = List.assoc name Plan_builder.vocabulary in
  Alcotest.(check (list string)) "goTo" common (arguments "goTo");
  Alcotest.(check (list string)) "loiter" ([ "radius"; "duration"; "direction" ] @ common) (arguments "loiter");
  Alcotest.(check (list string)) "planName" [] (arguments "planName");
  Alcotest.(check int) "settings" 16 (List.length Plan_builder.vocabulary);
  Alcotest.(check (list string))
    "units"
    [ "Speed.Units.METERS_PS"; "Speed.Units.RPM"; "Speed.Units.PERCENTAGE"; "Z.Units.DEPTH"; "Z.Units.ALTITUDE";
      "Z.Units.HEIGHT"; "Z.Units.NONE" ]
    Plan_builder.units

let () =
  Alcotest.run "plan builder"
    [ ("figure 8", [ case "builds exactly" figure_8 ]);
      ( "settings",
        [ case "defaults" plan_defaults; case "names" names; case "speed" speeds; case "z" depths;
          case "locate and move" locations; case "arguments hold for what follows" arguments_hold_on ] );
      ( "maneuvers",
        [ case "goTo and launch" simple_maneuvers; case "loiter" loiters; case "yoyo" yoyos; case "popup" pop_ups;
          case "skeeping" station_keepings; case "compassCalibration" compass_calibrations; case "rows" all_rows;
          case "followPath" paths; case "identifiers" identifiers; case "payload" payload ] );
      ("places", [ case "none" unplaced ]);
      ("exports", [ case "vocabulary" vocabulary ]) ]
