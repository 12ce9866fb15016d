open Dolphin_plans
open Test_support
module Place = Dolphin_geo.Place
module Wgs84 = Dolphin_geo.Wgs84
module Core = Dolphin_semantics.Core
module Mission_builder = Dolphin_semantics.Mission_builder
open Inline_plan

let case name run = Alcotest.test_case name `Quick run
let at (north, east) = Wgs84.displace Place.apdl ~north ~east

(* {1 Ways}

   Independently of the code that is tested: the moves and stays of a way from its first place on. *)

type part = {
  from : Position.t;
  towards : Position.t;
  seconds : float;
  is_stay : bool;
  speed : float;
  level : Plan.level;
}

let parts p =
  let of_leg (here, found) (leg : leg) =
    let part is_stay from towards seconds =
      { from; towards; seconds; is_stay; speed = leg.speed; level = leg.level } in
    let move (here, found) towards =
      match here with
      | None -> (Some towards, found)
      | Some from -> (Some towards, part false from towards (Wgs84.distance from towards /. leg.speed) :: found)
    in
    let here, found = List.fold_left move (here, found) leg.waypoints in
    match here with
    | Some place when Float.is_finite leg.dwell && leg.dwell > 0. -> (here, part true place place leg.dwell :: found)
    | Some _ | None -> (here, found)
  in
  List.rev (snd (List.fold_left of_leg (None, []) (path ~from:Place.feup ~speed:1. p)))

let total parts = List.fold_left (fun sum part -> sum +. part.seconds) 0. parts

(* The parts that remain after [seconds]: the first of them may be cut. *)
let rec after seconds = function
  | part :: rest when seconds > part.seconds +. 1e-6 -> after (seconds -. part.seconds) rest
  | part :: rest when part.is_stay -> { part with seconds = part.seconds -. seconds } :: rest
  | part :: rest when part.seconds > 0. ->
    let from = Wgs84.interpolate part.from part.towards (seconds /. part.seconds) in
    { part with from; seconds = part.seconds -. seconds } :: rest
  | parts -> parts

(* Without moves of centimetres and their times, and stays of one place in one. *)
let rec tidy = function
  | part :: rest when (not part.is_stay) && Wgs84.distance part.from part.towards < 0.05 -> tidy rest
  | part :: rest when part.is_stay && part.seconds < 1e-6 -> tidy rest
  | a :: b :: rest when a.is_stay && b.is_stay -> tidy ({ a with seconds = a.seconds +. b.seconds } :: rest)
  | part :: rest -> (
      match tidy rest with
      | b :: rest when part.is_stay && b.is_stay -> { part with seconds = part.seconds +. b.seconds } :: rest
      | rest -> part :: rest)
  | [] -> []

(* Stays may be longer by [spare] seconds, as they are whole. *)
let same ~spare a b =
  let is_same a b =
    a.is_stay = b.is_stay
    && Wgs84.distance a.from b.from < 1.
    && Wgs84.distance a.towards b.towards < 1.
    && (if a.is_stay then a.seconds -. 1e-3 <= b.seconds && b.seconds <= a.seconds +. spare
        else
          Float.abs (a.speed -. b.speed) < 1e-9
          && Float.abs (a.towards.height -. b.towards.height) < 1e-6
          && a.level.amplitude = b.level.amplitude && a.level.measured_from = b.level.measured_from)
  in
  List.compare_lengths a b = 0 && List.for_all2 is_same a b

(* {1 Plans} *)

let maneuver ?(id = "") ?(speed = (1.5, Plan.Metres_per_second)) ?(z = (2., Plan.Depth)) ?(payloads = []) kind place =
  { Plan.id; kind; location = at place; speed; z; payloads }

let plan maneuvers =
  let number i (m : Plan.maneuver) = if m.id = "" then { m with id = Printf.sprintf "%d.M" (i + 1) } else m in
  Maneuvers { name = "p"; description = "d"; vehicles = [ "v" ]; maneuvers = List.mapi number maneuvers }

let item word arguments = { Mission_plan.word; arguments }
let number name x = (name, Mission_plan.Number x)
let position place = ("position", Mission_plan.Place (at place))
let go ?(arguments = []) place = item "goPos" (position place :: arguments)
let mission items = Mission { name = "m"; vehicles = [ "v" ]; items }
let jump ?(times = 1.) n = item "jumpToItem" [ number "item" n; number "times" times ]

(* {1 What builders accept} *)

let setting (i : Mission_plan.item) =
  let value : Mission_plan.argument -> Core.value = function
    | Number x -> Number x
    | Truth b -> Boolean b
    | Text s -> String s
    | Place p -> Position p
    | Places ps -> List (Dolphin_semantics.Vector.of_list (List.map (fun p -> Core.Position p) ps))
  in
  { Core.setting = i.word; positional = []; named = List.map (fun (k, x) -> (k, value x)) i.arguments;
    setting_site = 0 }

let rec is_valid = function
  | Rest r -> is_valid r.plan
  | Mission m ->
    (match Mission_builder.build ~name:m.name 0 (List.map setting m.items) with
     | Ok built -> Mission_plan.compare { built with vehicles = m.vehicles } m = 0
     | Error _ -> false)
  | Maneuvers p ->
    let is_whole seconds = Float.is_integer seconds && 0. <= seconds && seconds <= 65535. in
    let fits (m : Plan.maneuver) =
      match m.kind with
      | Loiter { duration; _ } | Pop_up { duration; _ } | Station_keeping { duration; _ }
      | Compass_calibration { duration; _ } -> is_whole duration
      | Follow_path points ->
        let is_near metres = Float.abs metres <= 100_000. in
        points <> [] && List.for_all (fun (x, y, z) -> is_near x && is_near y && is_near z) points
      | Go_to | Launch | Yo_yo _ | Rows _ -> true
    in
    let ids = List.map (fun (m : Plan.maneuver) -> m.id) p.maneuvers in
    p.maneuvers <> [] && List.for_all fits p.maneuvers
    && List.length (List.sort_uniq String.compare ids) = List.length ids

(* {1 Cases} *)

let rec kinds = function
  | Rest r -> kinds r.plan
  | Maneuvers p -> List.map (fun (m : Plan.maneuver) -> m.id) p.maneuvers
  | Mission m -> List.map (fun (i : Mission_plan.item) -> i.word) m.items

let check_kinds what expected p = Alcotest.(check (list string)) what expected (kinds p)
let north metres = (metres, 0.)
let loiter duration = Plan.Loiter { radius = 20.; duration; direction = Clockwise }

(* 100 m at 1 m/s, then 100 s. *)
let there_and_stay =
  plan [ maneuver Go_to (0., 0.) ~speed:(1000., Revolutions_per_minute);
         maneuver (loiter 100.) (north 100.) ~speed:(1000., Revolutions_per_minute) ]

let rec duration_of p =
  match p with
  | Rest r -> duration_of r.plan
  | Maneuvers { maneuvers; _ } -> (
      match List.rev maneuvers with
      | { kind = Loiter { duration; _ }; _ } :: _ -> duration
      | _ -> nan)
  | Mission _ -> nan

let of_maneuvers =
  [ case "on the way" (fun () ->
        let rest = from_share 0.25 there_and_stay in
        check_kinds "kinds" [ "1.Goto"; "2.Loiter" ] rest;
        Alcotest.(check (float 0.1)) "half-way" 50.
          (Wgs84.distance (fst (Option.get (start rest))) (at (north 100.))));
    case "during the stay" (fun () ->
        let rest = from_share 0.75 there_and_stay in
        check_kinds "kinds" [ "1.Loiter" ] rest;
        Alcotest.(check (float 0.)) "seconds" 50. (duration_of rest));
    case "at the end" (fun () ->
        check_kinds "kinds" [ "1.Goto" ] (from_share 1. there_and_stay);
        check_kinds "beyond" [ "1.Goto" ] (from_share 7. there_and_stay);
        Alcotest.(check (float 0.)) "a moment before" 1. (duration_of (from_share 0.9999 there_and_stay)));
    case "without end" (fun () ->
        let p = plan [ maneuver Go_to (0., 0.); maneuver (loiter 0.) (north 100.) ] in
        check_kinds "goes on" [ "1.Loiter" ] (from_share 1. p);
        Alcotest.(check (float 0.)) "seconds" 0. (duration_of (from_share 1. p)));
    case "nothing to cut" (fun () ->
        let p = plan [ maneuver Go_to (0., 0.) ] in
        let is_whole x = Alcotest.(check int) "same" 0 (Inline_plan.compare p (from_share x p)) in
        List.iter is_whole [ -1.; 0.; 0.5; 1.; nan ]);
    case "rows become points" (fun () ->
        let rows =
          Plan.Rows
            { bearing = 0.; cross_angle = 0.; width = 40.; length = 100.; horizontal_step = 20.; curve_offset = 5.;
              alternation = 100.; square_curve = true; first_curve_right = true }
        in
        let payloads = [ { Plan.name = "Sidescan"; parameters = [ ("Active", "true") ] } ] in
        let rest = from_share 0.5 (plan [ maneuver rows (0., 0.) ~payloads; maneuver Go_to (0., 0.) ]) in
        check_kinds "kinds" [ "1.FollowPath"; "2.Goto" ] rest;
        Alcotest.(check (list string)) "payload" [ "Sidescan" ] (required_payload rest));
    case "identifiers of the program stay" (fun () ->
        let p = plan [ maneuver Go_to (0., 0.); maneuver Go_to (north 100.) ~id:"far"; maneuver Go_to (0., 0.) ] in
        check_kinds "kinds" [ "1.Goto"; "far"; "3.Goto" ] (from_share 0.25 p));
    case "launched again" (fun () ->
        let p = plan [ maneuver Launch (0., 0.); maneuver Go_to (north 100.) ] in
        check_kinds "kinds" [ "1.Launch"; "2.Goto"; "3.Goto" ] (from_share 0.25 p));
    case "a surface stay wherever it is" (fun () ->
        let pop_up =
          Plan.Pop_up { duration = 100.; current_position = true; wait_at_surface = true; station_keep = false } in
        let p = plan [ maneuver Go_to (0., 0.); maneuver pop_up (0., 0.); maneuver Go_to (north 1.) ] in
        check_kinds "kinds" [ "1.Goto"; "2.PopUp"; "3.Goto" ] (from_share 0.5 p)) ]

let square = [ at (0., 0.); at (100., 0.); at (100., 40.); at (0., 40.) ]
let survey = item "surveyArea" [ ("area", Mission_plan.Places square); number "spacing" 20. ]

let rec arguments n = function
  | Rest r -> arguments n r.plan
  | Mission m -> (List.nth m.items n).arguments
  | Maneuvers _ -> []

let items =
  [ case "takes off again" (fun () ->
        let p =
          mission
            [ item "arm" [ ("arm", Truth true) ]; item "takeOff" [ number "altitude" 30. ]; go (0., 0.);
              item "speed" [ number "speed" 5. ]; item "captureUntilStop" []; go (north 100.);
              item "landingPoint" [ position (north 100.) ] ]
        in
        let rest = from_share 0.5 p in
        check_kinds "items" [ "arm"; "takeOff"; "goPos"; "captureUntilStop"; "goPos"; "landingPoint" ] rest;
        Alcotest.(check bool) "altitude, speed" true
          (List.tl (arguments 2 rest) = [ number "altitude" 30.; number "speed" 5. ]);
        check_kinds "at its end" [ "arm"; "takeOff"; "goPos"; "captureUntilStop"; "goPos"; "landingPoint" ]
          (from_share 1. p));
    case "the lines of a survey" (fun () ->
        check_kinds "items" [ "goPos"; "goPos"; "goPos"; "goPos" ] (from_share 0.1 (mission [ survey ]));
        check_kinds "whole" [ "surveyArea" ] (from_share 0. (mission [ survey ])));
    case "comes home" (fun () ->
        let p =
          mission
            [ item "takeOff" [ number "altitude" 30. ]; go (0., 0.); go (north 100.); item "returnHomeAndLand" [] ] in
        check_kinds "on the way" [ "takeOff"; "goPos"; "goPos"; "returnHomeAndLand" ] (from_share 0.5 p);
        check_kinds "on the way home" [ "takeOff"; "goPos"; "returnHomeAndLand" ] (from_share 1. p);
        let has_way items = Inline_plan.way_from (mission items) <> None in
        let home = item "moveFromHome" [ number "north" 10. ] in
        Alcotest.(check (list bool)) "ways" [ true; false; false; false ]
          [ has_way [ item "takeOff" []; go (0., 0.); item "returnHome" []; item "delay" [ number "duration" 5. ] ];
            has_way [ go (0., 0.); home; go (0., 0.) ]; has_way [ item "returnHome" []; go (0., 0.) ];
            has_way [ item "takeOff" []; item "returnHomeAndLand" [] ] ]);
    case "rounds" (fun () ->
        let p = mission [ go (0., 0.); go (north 100.); jump 1. ~times:3.; go (0., 0.) ] in
        (* 800 m: there, and three times back and there, then back. *)
        let rest share = from_share (share /. 800.) p in
        check_kinds "in the first" [ "goPos"; "goPos"; "goPos"; "goPos"; "jumpToItem"; "goPos" ] (rest 50.);
        Alcotest.(check bool) "two more of its three" true
          (arguments 4 (rest 50.) = [ number "item" 3.; number "times" 2. ]);
        check_kinds "in the last but one" [ "goPos"; "goPos"; "goPos"; "goPos"; "goPos" ] (rest 450.);
        check_kinds "in the last" [ "goPos"; "goPos"; "goPos" ] (rest 650.));
    case "rounds without end" (fun () ->
        let p = mission [ go (0., 0.); go (north 100.); jump 1. ~times:(-1.) ] in
        let rest = from_share 1e-7 p in
        check_kinds "items" [ "goPos"; "goPos"; "goPos"; "goPos"; "jumpToItem" ] rest;
        Alcotest.(check bool) "without end" true (arguments 4 rest = [ number "item" 3.; number "times" (-1.) ]));
    case "begun again" (fun () ->
        let whole what items =
          Alcotest.(check int) what 0 (Inline_plan.compare (mission items) (from_share 0.5 (mission items))) in
        whole "forward" [ go (0., 0.); jump 3.; go (north 50.); go (north 100.) ];
        whole "climbing" [ go (0., 0.); go (north 100.) ~arguments:[ number "up" 1. ]; jump 1.; go (0., 0.) ];
        whole "from where it is" [ item "move" [ number "north" 10. ]; item "move" [ number "north" 10. ] ]);
    case "turns and seconds" (fun () ->
        let p word = mission [ go (0., 0.); item "loiterTurns" [ number "turns" word; position (0., 0.) ] ] in
        Alcotest.(check bool) "whole turns" true (List.mem (number "turns" 2.) (arguments 0 (from_share 0.4 (p 3.))));
        Alcotest.(check bool) "as many at most" true
          (List.mem (number "turns" 0.5) (arguments 0 (from_share 0.4 (p 0.5))));
        let delay = mission [ go (0., 0.); item "delay" [ number "duration" 10. ] ] in
        check_kinds "a delay" [ "goPos"; "delay" ] (from_share 0.5 delay);
        Alcotest.(check bool) "seconds" true (arguments 1 (from_share 0.5 delay) = [ number "duration" 5. ])) ]

(* {1 Laws} *)

module Gen = QCheck2.Gen

let ( let* ) = Gen.( >>= )
let ( let+ ) x f = Gen.map f x
let ( and* ) = Gen.pair
let ( and+ ) = Gen.pair
let place = Gen.(pair (map float_of_int (int_range (-300) 300)) (map float_of_int (int_range (-300) 300)))
let whole least most = Gen.map float_of_int (Gen.int_range least most)

let kind : Plan.kind Gen.t =
  let* duration = whole 0 200 and* radius = whole 1 50 and* angle = whole 0 359 and* width = whole 0 100 in
  let* yes = Gen.bool and* no = Gen.bool and* points = Gen.(list_size (int_range 1 8) place) in
  Gen.oneofl
    [ Plan.Go_to; Launch; Loiter { radius; duration; direction = Clockwise }; Yo_yo { amplitude = 4.; pitch = 15. };
      Pop_up { duration; current_position = yes; wait_at_surface = no; station_keep = false };
      Station_keeping { radius; duration };
      Compass_calibration { amplitude = 1.; radius; pitch = 15.; duration; direction = Clockwise };
      Rows
        { bearing = angle; cross_angle = 10.; width; length = 100.; horizontal_step = 20.; curve_offset = 5.;
          alternation = (if no then 50. else 100.); square_curve = yes; first_curve_right = no };
      Follow_path (List.map (fun (x, y) -> (x, y, 1.)) points) ]

let maneuvers =
  let one =
    let* kind = kind and* place = place and* n = Gen.int_range 1 20 and* by_rpm = Gen.bool and* z = whole 0 9 in
    let unit = if by_rpm then Plan.Revolutions_per_minute else Metres_per_second in
    let+ payload = Gen.oneofl [ []; [ { Plan.name = "Camera"; parameters = [] } ] ] in
    maneuver kind place ~speed:(float_of_int n /. 2., unit) ~z:(z, Depth) ~payloads:payload
  in
  Gen.map plan Gen.(list_size (int_range 1 6) one)

(* Items that go on from anywhere, and rounds of them, one within the other. *)
type block = Item of Mission_plan.item | Rounds of block list * float

let block =
  let item =
    let* there = place and* n = whole 1 60 and* height = whole 10 50 and* few = whole 1 4 in
    let arguments = Gen.oneofl [ []; [ number "altitude" height ]; [ number "speed" (n /. 4.) ] ] in
    let* arguments = arguments in
    Gen.oneofl
      [ go there ~arguments; item "move" (number "north" (fst there) :: number "east" (snd there) :: arguments);
        item "moveFromHome" (number "north" (fst there) :: arguments); item "returnHome" arguments;
        item "speed" [ number "speed" (n /. 4.) ]; item "altitude" [ number "altitude" height ];
        item "moveAndLoiter" ([ number "north" (fst there); number "duration" n ] @ arguments);
        item "loiterPos" [ position there; number "turns" few; number "radius" (-10.) ];
        item "returnHomeAndLoiter" [ number "duration" n ];
        item "loiterTurns" ([ number "turns" few ] @ arguments);
        item "loiterTime" [ number "duration" n; position there ];
        item "delay" [ number "duration" n ]; item "capturePhoto" []; item "captureUntilStop" [];
        item "stopCapturing" []; item "home" [ position there ]; survey; item "landingPoint" [ position there ] ]
  in
  let rec of_depth depth =
    let one = Gen.map (fun i -> Item i) item in
    if depth = 0 then one
    else
      let rounds =
        let* body = Gen.(list_size (int_range 1 3) (of_depth (depth - 1))) and* times = whole 0 3 in
        let* first = place in
        Gen.return (Rounds (Item (go first) :: body, times))
      in
      Gen.frequency [ (4, one); (1, rounds) ]
  in
  of_depth 2

let missions =
  let rec add (next, found) = function
    | Item i -> ((if Mission_plan.is_numbered i then next + 1 else next), i :: found)
    | Rounds (body, times) ->
      let last, found = List.fold_left add (next, found) body in
      (last + 1, jump (float_of_int next) ~times :: found)
  in
  let+ blocks = Gen.(list_size (int_range 1 8) block) and+ height = whole 10 50 in
  let beginning =
    [ item "takeOff" [ number "altitude" height ]; item "home" [ position (10., 10.) ]; go (0., 0.) ] in
  mission (List.rev (snd (List.fold_left add (4, List.rev beginning) blocks)))

let rec written = function
  | Rest r -> written r.plan
  | Maneuvers p ->
    let of_maneuver (m : Plan.maneuver) =
      Format.asprintf "%s %a %g" m.id Position.pp m.location (fst m.speed) in
    String.concat "\n" (List.map of_maneuver p.maneuvers)
  | Mission m ->
    let argument (name, (x : Mission_plan.argument)) =
      match x with
      | Number x -> Printf.sprintf "%s %g" name x
      | Place p -> Format.asprintf "%a" Position.pp p
      | Truth _ | Text _ | Places _ -> name
    in
    let of_item (i : Mission_plan.item) = String.concat " " (i.word :: List.map argument i.arguments) in
    String.concat "\n" (List.map of_item m.items)

let print (p, x, y) = Printf.sprintf "%s\n%.17g, %.17g\nrest:\n%s" (written p) x y (written (from_share x p))
let cuts p = Gen.triple p (Gen.float_range 0. 1.) (Gen.float_range 0. 1.)

(* The longest turn that is flown whole: a circle of the usual radius at the slowest speed, or seconds made whole. *)
let rec spare = function Rest r -> spare r.plan | Maneuvers _ -> 1. | Mission _ -> 1. +. (2. *. Float.pi *. 50. /. 0.25)

let begins_where_cut (p, x, _) =
  let all = parts p in
  let expected = tidy (after (x *. total all) all) and rest = from_share x p in
  total all = 0. || same ~spare:(spare p) expected (tidy (parts rest))

let again (p, x, y) =
  let once = from_share (x +. ((1. -. x) *. y)) p and rest = from_share x p in
  begins_where_cut (rest, y, 0.)
  && Float.abs (total (parts once) -. total (parts (from_share y rest))) <= 2. *. spare p

let lengths (p, x, _) =
  let all = total (parts p) in
  let expected = (1. -. x) *. all and rest = total (parts (from_share x p)) in
  all = 0. || (expected -. 0.05 <= rest && rest <= expected +. spare p)

let laws name p =
  let law what = Property.case ~count:300 (name ^ ": " ^ what) ~print (cuts p) in
  [ law "nothing done is the plan" (fun (p, _, _) -> Inline_plan.compare p (from_share 0. p) = 0);
    law "goes on where it was cut" begins_where_cut;
    law "takes the rest of the time" lengths;
    law "cut twice" again;
    law "builders accept it" (fun (p, x, y) ->
        is_fixed p
        && List.for_all is_valid [ p; from_share x p; from_share 1. p; from_share y (from_share x p) ]);
    law "its name and vehicles" (fun (p, x, _) ->
        let rest = from_share x p in
        Inline_plan.name rest = Inline_plan.name p && vehicles rest = vehicles p);
    law "asks for the vehicles that the whole asks for, known or not" (fun (p, x, y) ->
        let asks rest = required_payload rest = required_payload p && reference rest = reference p in
        let rest = from_share x p in
        List.for_all asks [ rest; some_rest p; some_rest rest; from_share y rest ]);
    law "a rest of the plan, and of no other" (fun (p, x, y) ->
        let rest = from_share x p in
        let is_part q = Inline_plan.compare (any_part p) (any_part q) = 0 in
        List.for_all is_part [ p; rest; some_rest p; some_rest rest; from_share y rest ]
        && fst (begun rest) = fst (begun p)) ]

let () =
  Alcotest.run "rest of a plan"
    [ ("maneuvers", of_maneuvers); ("items", items); ("laws of maneuvers", laws "maneuvers" maneuvers);
      ("laws of missions", laws "missions" missions) ]
