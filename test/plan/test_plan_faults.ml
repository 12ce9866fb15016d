open Dolphin_semantics
open Core
open Writing
module Place = Dolphin_geo.Place

let fails ?(site = 0) message settings () =
  match build settings with
  | Ok _ -> Alcotest.failf "accepted; should say: %s" message
  | Error fault -> Alcotest.(check (pair int string)) "fault" (site, message) (fault.site, fault.message)

let fault ?site message settings = case message (fails ?site message settings)

let loiter named = [ man "loiter" named ]
let mistaken named = [ man "goTo" [ ("payload", named) ] ]
let points xs = [ man "followPath" [ ("points", xs) ] ]

let setting_faults =
  [ fault "an inline plan has no setting 'goto': did you mean goTo?" [ man "goto" [] ];
    fault ~site:1
      "an inline plan has no setting 'somersault': it has planName, description, vehicles, speed, z, locate, move, \
       goTo, loiter, yoyo, popup, skeeping, compassCalibration, launch, rows, followPath"
      [ go; man "somersault" [] ];
    fault ~site:plan_site "plan 'p' has no maneuver, such as goTo or loiter" [];
    fault ~site:plan_site "plan 'q' has no maneuver, such as goTo or loiter" [ set "planName" [ str "q" ] ];
    fault "planName takes one string" [ set "planName" [] ];
    fault "planName takes no named arguments, such as 'id'" [ set "planName" [ str "p" ] ~named:[ ("id", i 1) ] ];
    fault "expected a string as planName, found a number, 5" [ set "planName" [ i 5 ] ];
    fault "planName is empty" [ set "planName" [ str "" ] ];
    fault "description takes one string" [ set "description" [ str "a"; str "b" ] ];
    fault "expected a string as description, found null" [ set "description" [ Null ] ];
    fault "vehicles lacks the names of vehicles" [ set "vehicles" [] ];
    fault "expected names of vehicles, as in vehicles 'lauv-noptilus-1', 'lauv-noptilus-2', found a number, 1"
      [ set "vehicles" [ str "x"; i 1 ] ];
    fault "locate takes a position, or latitude and longitude in degrees" [ set "locate" [] ];
    fault "expected a position after locate, found a string, 'here'" [ set "locate" [ str "here" ] ];
    fault "latitude 91 is not from -90 to 90 degrees" [ set "locate" [ i 91; i 0 ] ];
    fault "longitude -181 is not from -180 to 180 degrees" [ set "locate" [ i 1; i (-181) ] ];
    fault "expected a number as longitude, found a string, 'x'" [ set "locate" [ i 1; str "x" ] ];
    fault "latitude is a finite number, not nan" [ set "locate" [ n Float.nan; i 0 ] ];
    fault "move takes two numbers: metres to the north and metres to the east" [ set "move" [ i 1 ] ];
    fault "expected a number as move to the east, found the wildcard _, _" [ set "move" [ i 1; Wildcard ] ];
    fault "move to the north is from -20000000 to 20000000 m, not 1e+300" [ set "move" [ n 1e300; i 0 ] ];
    fault "move to the north is a finite number, not inf" [ set "move" [ n Float.infinity; i 0 ] ] ]

let quantity_faults =
  [ fault "speed is a number and a unit, as in speed 1, Speed.Units.METERS_PS" [ set "speed" [] ];
    fault "expected a number as speed, found a string, 'fast'" [ set "speed" [ str "fast" ] ];
    fault "'Speed.Units.RMP' is not a unit of speed: did you mean Speed.Units.RPM?"
      [ set "speed" [ i 1; sym "Speed.Units.RMP" ] ];
    fault "'Z.Units.DEPTH' is not a unit of speed: units are Speed.Units.METERS_PS, \
           Speed.Units.RPM, Speed.Units.PERCENTAGE"
      [ set "speed" [ i 1; sym "Z.Units.DEPTH" ] ];
    fault "expected a unit of speed, as in Speed.Units.METERS_PS, found a number, 2" [ set "speed" [ i 1; i 2 ] ];
    fault "speed is at most 100 m/s, not 900: if the unit is another, name it, as in speed 900, Speed.Units.RPM"
      [ set "speed" [ i 900 ] ];
    fault "speed is greater than 0 and at most 100 m/s, not 0" [ set "speed" [ i 0 ] ];
    fault "speed is greater than 0 and at most 100000 RPM, not -900"
      [ set "speed" [ i (-900); sym "Speed.Units.RPM" ] ];
    fault "speed is greater than 0 and at most 100 percent, not 0"
      [ set "speed" [ i 0; sym "Speed.Units.PERCENTAGE" ] ];
    fault "speed is from 0 to 100 percent, not 101" [ set "speed" [ i 101; sym "Speed.Units.PERCENTAGE" ] ];
    fault "speed counts percent from 0 to 100, and 0.8 is hardly meant: write 50 for half, not 50.percent"
      [ set "speed" [ n 0.8; sym "Speed.Units.PERCENTAGE" ] ];
    fault "z is a number and a unit, as in z 1, Z.Units.DEPTH" [ set "z" [ i 1; i 2; i 3 ] ];
    fault "'Z.Units.DEEP' is not a unit of z: did you mean Z.Units.DEPTH?" [ set "z" [ i 1; sym "Z.Units.DEEP" ] ];
    fault "depth is from 0 to 100000 m, not -1" [ set "z" [ i (-1) ] ];
    fault "altitude is from 0 to 100000 m, not -1" [ set "z" [ i (-1); sym "Z.Units.ALTITUDE" ] ];
    fault "z is from -100000 to 100000 m, not 1000000" [ set "z" [ i 1000000; sym "Z.Units.HEIGHT" ] ] ]

let argument_faults =
  [ fault "loiter has no argument 'raduis': did you mean radius?" (loiter [ ("raduis", i 5) ]);
    fault "goTo has no argument 'wingspan': it takes speed, z, location, id, payload"
      [ man "goTo" [ ("wingspan", i 5) ] ];
    fault "loiter has its argument 'radius' twice" (loiter [ ("radius", i 5); ("radius", i 6) ]);
    fault "loiter takes only named arguments, as in loiter speed:1.5" [ set "loiter" [ i 100 ] ];
    fault "expected a number as radius of loiter, found a string, 'wide'" (loiter [ ("radius", str "wide") ]);
    fault "radius of loiter is from 1 to 100000 m, not -5" (loiter [ ("radius", i (-5)) ]);
    fault "duration of loiter is a whole number from 0 to 65535 seconds, not 65536" (loiter [ ("duration", i 65536) ]);
    fault "duration of loiter is a whole number from 0 to 65535 seconds, not -1" (loiter [ ("duration", i (-1)) ]);
    fault "duration of loiter is a whole number from 0 to 65535 seconds, not 0.5" (loiter [ ("duration", n 0.5) ]);
    fault "'LEFT' is not a direction of loiter: there are VDEP, CLOCKW, CCLOCKW, IWINDCURR"
      (loiter [ ("direction", str "LEFT") ]);
    fault "'CLOCKWISE' is not a direction of loiter: did you mean CLOCKW?" (loiter [ ("direction", str "CLOCKWISE") ]);
    fault "expected a position as location of loiter, found a number, 4" (loiter [ ("location", i 4) ]);
    fault "latitude 100 is not from -90 to 90 degrees" (loiter [ ("location", items [ i 100; i 0 ]) ]);
    fault "expected a string as id of loiter, found a number, 4" (loiter [ ("id", i 4) ]);
    fault ~site:1 "another maneuver of the plan has the id 'here'"
      [ man "goTo" [ ("id", str "here") ]; man "loiter" [ ("id", str "here") ] ];
    fault "pitch of yoyo is from 0 to 45 degrees, not 50" [ man "yoyo" [ ("pitch", i 50) ] ];
    fault "with a pitch of 0 degrees, yoyo does not move up and down" [ man "yoyo" [ ("pitch", i 0) ] ];
    fault "min_depth of yoyo is from 0 to 100000 m, not -2" [ man "yoyo" [ ("min_depth", i (-2)) ] ];
    fault "max_depth of yoyo is deeper than min_depth, but here they are 2 and 2 m"
      [ man "yoyo" [ ("max_depth", i 2) ] ];
    fault "expected true or false as currPos of popup, found a number, 1" [ man "popup" [ ("currPos", i 1) ] ];
    fault "popup starts at the current position or at a location, not at both: leave out currPos or location"
      [ man "popup" [ ("currPos", Boolean true); ("location", Position Place.feup) ] ];
    fault "pitch of compassCalibration is from -90 to 90 degrees, not 91"
      [ man "compassCalibration" [ ("pitch", i 91) ] ];
    fault "amplitude of compassCalibration is from 0 to 100000 m, not -1"
      [ man "compassCalibration" [ ("amplitude", i (-1)) ] ];
    fault ~site:1 "compassCalibration needs a z in Z.Units.DEPTH or Z.Units.ALTITUDE"
      [ set "z" [ i 50; sym "Z.Units.HEIGHT" ]; man "compassCalibration" [] ] ]

let rows_faults =
  let rows k x = [ man "rows" [ (k, x) ] ] in
  [ fault "bearing of rows is from -360 to 360 degrees, not 361" (rows "bearing" (i 361));
    fault "cross_angle of rows is from -60 to 60 degrees, not 61" (rows "cross_angle" (i 61));
    fault "width of rows is from 0 to 100000 m, not -1" (rows "width" (i (-1)));
    fault "length of rows is from 0 to 100000 m, not -1" (rows "length" (i (-1)));
    fault "hstep of rows is greater than 0 and at most 100000 m, not 0" (rows "hstep" (i 0));
    fault "hstep of rows is too small: 100 m in steps of 0.001 m are more than 10000 rows" (rows "hstep" (n 0.001));
    fault "coff of rows is a whole number from 0 to 255 m, not 256" (rows "coff" (i 256));
    fault "curvOff of rows is a whole number from 0 to 255 m, not 1.5" (rows "curvOff" (n 1.5));
    fault "alternation of rows is from 0 to 100 percent, not 101" (rows "alternation" (i 101));
    fault "alternation of rows is a whole number from 0 to 100 percent, not 33.3" (rows "alternation" (n 33.3));
    fault "alternation of rows counts percent from 0 to 100, and 0.5 is hardly meant: write 50 for half, not 50.percent"
      (rows "alternation" (n 0.5));
    fault "expected true or false as squareCurve of rows, found a string, 'yes'" (rows "squareCurve" (str "yes")) ]

let list_faults =
  let a_point = "expected points of followPath as [north, east], [north, east, down] or positions, found " in
  [ fault "followPath lacks its points, as in points:[[0, 0], [100, 50]]" [ man "followPath" [] ];
    fault "followPath lacks its points, as in points:[[0, 0], [100, 50]]" (points (items []));
    fault (a_point ^ "a number, 5") (points (i 5));
    fault (a_point ^ "a list, [1]") (points (items [ items [ i 1 ] ]));
    fault "expected a number as east of a point, found a string, 'x'" (points (items [ items [ i 1; str "x" ] ]));
    fault "down of a point is from -100000 to 100000 m, not 1e+30" (points (items [ items [ i 1; i 1; n 1e30 ] ]));
    fault "a point of followPath lacks its east" (points (items [ Map [ ("north", i 1) ] ]));
    fault "a point has no 'nort': did you mean north?" (points (items [ Map [ ("nort", i 1); ("east", i 1) ] ]));
    case "a point too far away" (fun () ->
        match build (points (items [ Position { latitude = 0.; longitude = 0.; height = 0. } ])) with
        | Ok _ -> Alcotest.fail "accepted"
        | Error fault ->
          let start = "the distance of a point is from 0 to 100000 m, not " in
          Alcotest.(check string) "fault" start (String.sub fault.message 0 (String.length start)));
    fault "expected devices as payload of goTo, as in [[name:'Camera', Frequency:50]], found a number, 5"
      (mistaken (items [ i 5 ]));
    fault "payload of goTo lacks its name, as in [name:'Camera']" (mistaken (items [ Map [ ("Range", i 5) ] ]));
    fault "name in payload of goTo is empty" (mistaken (Map [ ("name", str "") ]));
    fault "expected a string as name in payload of goTo, found a number, 3" (mistaken (Map [ ("name", i 3) ]));
    fault "expected a number, a string or true or false as Range of Camera, found a list, []"
      (mistaken (Map [ ("name", str "Camera"); ("Range", items []) ])) ]

(* {1 Anything at all} *)

(* Whatever a program writes, it gets a plan or a fault at a setting, never an exception; and in a plan no identifier
   stands twice. *)
let random_settings =
  let open QCheck2.Gen in
  let number =
    oneof
      [ map i (int_range (-200) 400); map n (float_bound_inclusive 100.);
        oneofl [ n Float.nan; n Float.infinity; n 1e300; n (-0.); i max_int; i min_int ] ]
  in
  let value =
    fix
      (fun value depth ->
         let leaf =
           oneof
             [ number; number;
               map str (oneofl [ ""; "x"; "1.Goto"; "rpm"; "CLOCKW" ]);
               map sym (oneofl Plan_builder.units);
               oneofl [ Null; Wildcard; Boolean true; Position Place.feup; Vehicles [ "v" ] ] ]
         in
         if depth = 0 then leaf
         else
           let inside = value (depth - 1) in
           frequency
             [ (4, leaf);
               (1, map items (list_size (int_range 0 3) inside));
               (1, map (fun x -> Map [ ("name", str "Camera"); ("x", x) ]) inside) ])
      2
  in
  let setting =
    let* setting, arguments = oneofl (("unknown", [ "x" ]) :: Plan_builder.vocabulary) in
    let* positional = if arguments = [] then list_size (int_range 0 2) value else return [] in
    let* named = if arguments = [] then return [] else list_size (int_range 0 2) (pair (oneofl arguments) value) in
    return (set setting positional ~named)
  in
  list_size (int_range 1 4) setting

let total =
  let print = Format.asprintf "%a" (Format.pp_print_list (fun ppf s -> Format.pp_print_string ppf s.setting)) in
  let plans = ref 0 in
  let holds settings =
    match build settings with
    | Error fault -> fault.message <> "" && (fault.site = plan_site || fault.site < List.length settings)
    | Ok plan ->
      Test_support.Property.count plans;
      let ids = List.map (fun (m : Dolphin_plans.Plan.maneuver) -> m.id) plan.maneuvers in
      List.length (List.sort_uniq String.compare ids) = List.length ids
      && List.length (Dolphin_plans.Plan.path plan) = List.length ids
  in
  let name = "random settings give a plan or a fault" in
  [ Test_support.Property.case ~count:20_000 name ~print random_settings holds;
    case "enough plans among them" (fun () -> Alcotest.(check bool) "more than 1,000" true (!plans > 1000)) ]

let () =
  Alcotest.run "plan faults"
    [ ("settings", setting_faults);
      ("speed and z", quantity_faults);
      ("arguments", argument_faults);
      ("rows", rows_faults);
      ("points and payload", list_faults);
      ("anything at all", total) ]
