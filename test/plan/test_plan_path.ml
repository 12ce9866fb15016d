open Dolphin_plans
module Position = Dolphin_geo.Position
module Place = Dolphin_geo.Place
module Wgs84 = Dolphin_geo.Wgs84

let case name run = Alcotest.test_case name `Quick run
let near = Alcotest.testable Position.pp (fun a b -> Wgs84.distance a b < 1e-3)

let maneuver ?(id = "m") ?(speed = (900., Plan.Revolutions_per_minute)) kind =
  { Plan.id; kind; location = Place.apdl; speed; z = (2., Depth); payloads = [] }

let plan maneuvers = { Plan.name = "p"; description = ""; vehicles = []; maneuvers }

let leg kind =
  match Plan.path (plan [ maneuver kind ]) with [ leg ] -> leg | _ -> Alcotest.fail "not one leg"

let at (north, east) = Wgs84.displace Place.apdl ~north ~east

let check what kind offsets dwell =
  let leg = leg kind in
  Alcotest.(check (list near)) what (List.map at offsets) leg.waypoints;
  Alcotest.(check (float 0.)) (what ^ ": dwell") dwell leg.dwell

let here = [ (0., 0.) ]

let single_places () =
  check "goTo" Go_to here 0.;
  check "launch" Launch here 0.;
  check "yoyo" (Yo_yo { amplitude = 18.; pitch = 15. }) here 0.;
  check "loiter" (Loiter { radius = 20.; duration = 60.; direction = Clockwise }) here 60.;
  check "skeeping without end" (Station_keeping { radius = 20.; duration = 0. }) here infinity;
  check "compassCalibration"
    (Compass_calibration { amplitude = 1.; radius = 5.; pitch = 15.; duration = 300.; direction = Clockwise })
    here 300.

let pop_ups () =
  let pop_up current_position wait_at_surface =
    Plan.Pop_up { duration = 180.; current_position; wait_at_surface; station_keep = false }
  in
  check "wherever it is" (pop_up true false) [] 0.;
  check "at a place, waiting" (pop_up false true) here 180.

(* The heights of a maneuver's places, of its stay, and of its ups and downs, with [z] of [unit]. *)
let levels () =
  let check what kind z ?(above = 0.) places (stays_at, amplitude, pitch) =
    let m = { (maneuver kind) with z; location = { Place.apdl with height = above } } in
    let leg = List.hd (Plan.path (plan [ m ])) in
    let heights = List.map (fun (p : Position.t) -> p.height) leg.waypoints in
    Alcotest.(check (list (float 1e-9))) what (places @ [ stays_at; amplitude; pitch ])
      (heights @ [ leg.level.stays_at; leg.level.amplitude; leg.level.pitch ])
  in
  check "depth" Go_to (5., Depth) ~above:30. [ -5. ] (-5., 0., 0.);
  check "height" Go_to (5., Height) ~above:30. [ 5. ] (5., 0., 0.);
  check "altitude" Go_to (5., Altitude) ~above:30. [ 35. ] (35., 0., 0.);
  check "yoyo" (Yo_yo { amplitude = 18.; pitch = 15. }) (11., Depth) [ -11. ] (-11., 9., 15.);
  check "compassCalibration"
    (Compass_calibration { amplitude = 1.; radius = 5.; pitch = 10.; duration = 300.; direction = Clockwise })
    (11., Depth) [ -11. ] (-11., 1., 10.);
  check "followPath" (Follow_path [ (1., 0., 2.); (2., 0., -1.) ]) (4., Depth) [ -6.; -3. ] (-4., 0., 0.);
  let pop_up current_position =
    Plan.Pop_up { duration = 9.; current_position; wait_at_surface = true; station_keep = false } in
  check "popup" (pop_up true) (4., Depth) [] (0., 0., 0.);
  check "popup elsewhere" (pop_up false) (4., Depth) [ -4. ] (0., 0., 0.)

let follow_path () =
  let points = [ (10., 0., 1.); (10., 20., 2.); (-5., 0., 0.) ] in
  check "points" (Follow_path points) (List.map (fun (north, east, _) -> (north, east)) points) 0.

let rows ?(bearing = 0.) ?(cross_angle = 0.) ?(width = 40.) ?(alternation = 100.) ?(square_curve = true)
    ?(first_curve_right = true) () =
  Plan.Rows
    {
      bearing;
      cross_angle;
      width;
      length = 100.;
      horizontal_step = 20.;
      curve_offset = 5.;
      alternation;
      square_curve;
      first_curve_right;
    }

(* By hand from DUNE's stages: approach, start, up, curve, its end, down, curve, its end, ... *)
let square =
  [ (-5., 0.); (0., 0.); (105., 0.); (105., 20.); (100., 20.); (-5., 20.); (-5., 40.); (0., 40.); (105., 40.) ]

let all_rows () =
  check "square curves" (rows ()) square 0.;
  check "to the left" (rows ~first_curve_right:false ()) (List.map (fun (x, y) -> (x, -.y)) square) 0.;
  check "eastward" (rows ~bearing:90. ()) (List.map (fun (x, y) -> (-.y, x)) square) 0.;
  check "diagonal curves"
    (rows ~square_curve:false ())
    [ (-5., 0.); (0., 0.); (105., 0.); (100., 20.); (-5., 20.); (0., 40.); (105., 40.) ]
    0.;
  check "narrower than a step" (rows ~width:19. ()) [ (-5., 0.); (0., 0.); (105., 0.) ] 0.;
  check "alternation"
    (rows ~alternation:50. ())
    [ (-5., 0.); (0., 0.); (105., 0.); (105., 10.); (100., 10.); (-5., 10.); (-5., 40.); (0., 40.); (105., 40.) ]
    0.;
  let slip = 20. *. sin (Float.pi /. 6.) and step = 20. *. cos (Float.pi /. 6.) in
  check "cross angle"
    (rows ~width:20. ~cross_angle:30. ())
    [ (-5., 0.); (0., 0.); (105., 0.); (105. -. slip, step); (100. -. slip, step); (-5. -. slip, step) ]
    0.;
  check "back and forth on one row"
    (rows ~width:20. ~alternation:0. ())
    [ (-5., 0.); (0., 0.); (105., 0.); (105., 0.); (100., 0.); (-5., 0.); (-5., 40.); (0., 40.); (105., 40.);
      (105., 40.); (100., 40.); (-5., 40.) ]
    0.

let legs () =
  let ids =
    Plan.path (plan [ maneuver ~id:"a" Go_to; maneuver ~id:"b" Launch ])
    |> List.map (fun (leg : Plan.leg) -> leg.maneuver)
  in
  Alcotest.(check (list string)) "one each, in order" [ "a"; "b" ] ids

let speeds () =
  let check what expected speed =
    Alcotest.(check (float 0.)) what expected (Plan.metres_per_second (maneuver ~speed Go_to) ~default:1.25)
  in
  check "m/s" 1.5 (1.5, Metres_per_second);
  check "rpm" 1.25 (900., Revolutions_per_minute);
  check "percent" 1.25 (80., Percent)

let () =
  Alcotest.run "plan path"
    [ ( "path",
        [ case "single places" single_places; case "popup" pop_ups; case "levels" levels; case "followPath" follow_path;
          case "rows" all_rows; case "legs" legs ] );
      ("speed", [ case "metres per second" speeds ]) ]
