open Dolphin_plans
open Test_support
module Place = Dolphin_geo.Place
module Wgs84 = Dolphin_geo.Wgs84
module Position = Dolphin_geo.Position

let at (north, east) = Wgs84.displace Place.apdl ~north ~east

(* {1 Flights} *)

(* A part of a flight: its seconds as they are flown, and as a share counts them. *)
type part = { from : Position.t; towards : Position.t; seconds : float; counts : float }

(* From the first place on. *)
let parts ~speed p =
  let legs s = Inline_plan.path ~from:Place.feup ~speed:s p in
  let add (here, found) (leg : Inline_plan.leg) (counted : Inline_plan.leg) =
    let move (here, found) towards =
      match here with
      | None -> (Some towards, found)
      | Some from ->
        let metres = Wgs84.distance from towards in
        (Some towards, { from; towards; seconds = metres /. leg.speed; counts = metres /. counted.speed } :: found)
    in
    let here, found = List.fold_left move (here, found) leg.waypoints in
    match here with
    | Some place when leg.dwell > 0. ->
      (here, { from = place; towards = place; seconds = leg.dwell; counts = counted.dwell } :: found)
    | Some _ | None -> (here, found)
  in
  List.rev (snd (List.fold_left2 add (None, []) (legs speed) (legs 1.)))

let sum f parts = List.fold_left (fun sum part -> sum +. f part) 0. parts

(* Where the vehicle is [seconds] after it was at the first place. *)
let rec place_after seconds = function
  | [ part ] when seconds >= part.seconds -> part.towards
  | part :: rest when seconds > part.seconds -> place_after (seconds -. part.seconds) rest
  | part :: _ ->
    if part.seconds = 0. then part.towards else Wgs84.interpolate part.from part.towards (seconds /. part.seconds)
  | [] -> invalid_arg "place_after"

(* The seconds of the flight at which a share is done. *)
let seconds_of_share parts share =
  let rec go counts seconds = function
    | part :: _ when counts <= part.counts && part.counts > 0. -> seconds +. (part.seconds *. counts /. part.counts)
    | part :: rest -> go (counts -. part.counts) (seconds +. part.seconds) rest
    | [] -> seconds
  in
  go (share *. sum (fun part -> part.counts) parts) 0. parts

(* {1 Reports} *)

type flight = {
  name : string;
  plan : Inline_plan.t;
  speed : float;
  approach : float * float;  (* where the vehicle comes from *)
  gaps : float list;  (* seconds between reports, again and again *)
  errors : (float * float) list;  (* metres to the north and to the east, again and again *)
  tells_speed : bool;
}

(* How far the tracker is from the truth at each report, in seconds of flight. *)
let track ?(from = 0.) f =
  let parts = parts ~speed:f.speed f.plan in
  let first = (List.hd parts).from and before = at f.approach in
  let coming = Wgs84.distance before first /. f.speed and all = sum (fun part -> part.seconds) parts in
  let gaps = Array.of_list f.gaps and errors = Array.of_list f.errors in
  let rec go i time t found =
    if time > coming +. all then (t, List.rev found)
    else
      let seconds = time -. coming in
      let truth = if seconds < 0. then Wgs84.interpolate before first (time /. coming) else place_after seconds parts in
      let north, east = errors.(i mod Array.length errors) in
      let t' = Progress.observe ~at:(1000. +. time) (Wgs84.displace truth ~north ~east) t in
      if Progress.share t' < Progress.share t then Alcotest.fail "the share fell";
      let believed = seconds_of_share parts (Progress.share t') in
      let found = (time, Float.max 0. seconds, believed) :: found in
      go (i + 1) (time +. gaps.(i mod Array.length gaps)) t' found
  in
  match Progress.start ~speed:(if f.tells_speed then f.speed else nan) f.plan with
  | None -> Alcotest.fail "no progress"
  | Some t -> go 0 from t []

(* {1 Plans} *)

let maneuver ?(unit = Plan.Metres_per_second) ~speed kind place =
  { Plan.id = ""; kind; location = at place; speed = (speed, unit); z = (2., Depth); payloads = [] }

let plan maneuvers =
  let number i (m : Plan.maneuver) = { m with id = string_of_int i } in
  Inline_plan.Maneuvers { name = "p"; description = ""; vehicles = []; maneuvers = List.mapi number maneuvers }

let goes ~speed places = plan (List.map (maneuver ~speed Go_to) places)

let rows ?(width = 100.) ?(step = 20.) ~square () =
  Plan.Rows
    { bearing = 30.; cross_angle = 0.; width; length = 150.; horizontal_step = step; curve_offset = 10.;
      alternation = 100.; square_curve = square; first_curve_right = true }

let loiter duration = Plan.Loiter { radius = 20.; duration; direction = Clockwise }

module Gen = QCheck2.Gen

let ( let* ) = Gen.( >>= )
let ( let+ ) x f = Gen.map f x
let ( and* ) = Gen.pair
let metres most = Gen.map float_of_int (Gen.int_range (-most) most)

(* Each with its name. *)
let plans ~speed =
  let m = maneuver ~speed in
  let* place = Gen.pair (metres 300) (metres 300) and* square = Gen.bool and* seconds = Gen.int_range 5 300 in
  let* places = Gen.(list_size (int_range 2 8) (pair (metres 400) (metres 400))) in
  Gen.oneofl
    [ ("rows", plan [ m (rows ~square ()) place ]);
      ("there and back", goes ~speed [ (0., 0.); (300., 0.); (0., 0.); (300., 0.); (0., 0.) ]);
      ("a crossing", goes ~speed [ (0., 0.); (300., 300.); (300., 0.); (0., 300.); (0., 0.) ]);
      ("rounds", goes ~speed (List.concat (List.init 3 (fun _ -> [ (0., 0.); (150., 0.); (150., 150.); (0., 150.) ]))));
      ("stays", plan [ m Go_to (0., 0.); m (loiter (float_of_int seconds)) (200., 0.); m Go_to (0., 50.);
                       m (Station_keeping { radius = 10.; duration = float_of_int seconds }) (0., 100.) ]);
      ("places", goes ~speed places) ]

let flights ~least ~most =
  let* speed = Gen.oneofl [ 1.; 1.5; 5.; 20. ] in
  let* name, plan = plans ~speed in
  let* approach = Gen.pair (metres 400) (metres 400) in
  let* gaps = Gen.(list_size (int_range 1 30) (float_range least most)) in
  let+ errors = Gen.(list_size (int_range 1 30) (pair (float_range (-3.5) 3.5) (float_range (-3.5) 3.5))) in
  { name; plan; speed; approach; gaps; errors; tells_speed = true }

(* 20 metres of the way, or 2 seconds; after a long silence, up to that many seconds more for each second of it. *)
let tolerance f =
  let silence = List.fold_left Float.max 0. f.gaps in
  Float.max 2. (20. /. f.speed) +. (0.25 *. Float.max 0. (silence -. 5.))

let misses f =
  List.filter (fun (_, truth, believed) -> Float.abs (truth -. believed) > tolerance f) (snd (track f))

let print f =
  let points pp points = String.concat " " (List.map pp points) in
  let offset (north, east) = Printf.sprintf "(%.1f, %.1f)" north east in
  let miss (time, truth, believed) = Printf.sprintf "%.1f: %.1f, tracked %.1f" time truth believed in
  Printf.sprintf "%s at %g m/s from %s; gaps %s; errors %s; %s\n%s" f.name f.speed (offset f.approach)
    (points (Printf.sprintf "%g") f.gaps) (points offset f.errors)
    (points (fun part -> offset (Wgs84.displacement Place.apdl part.from)) (parts ~speed:f.speed f.plan))
    (String.concat "\n" (List.filteri (fun i _ -> i < 5) (List.map miss (misses f))))

let follows f = misses f = []

let laws =
  let law what ~least ~most = Property.case ~count:200 what ~print (flights ~least ~most) follows in
  [ law "often" ~least:0.5 ~most:2.; law "seldom" ~least:0.5 ~most:60. ]

let () = Alcotest.run "progress" [ ("flights", laws) ]
