open Dolphin_plans
open Test_support
module Place = Dolphin_geo.Place
module Wgs84 = Dolphin_geo.Wgs84
module Position = Dolphin_geo.Position

let case name run = Alcotest.test_case name `Quick run
let at (north, east) = Wgs84.displace Place.apdl ~north ~east

(* {1 Flights} *)

(* A part of a flight: its seconds as they are flown, and as a share counts them. *)
type part = { from : Position.t; towards : Position.t; seconds : float; counts : float }

(* From the first place on, by a vehicle that is [pace] times as fast as its plan. *)
let parts ?(pace = 1.) ~speed p =
  let legs s = Inline_plan.path ~from:Place.feup ~speed:s p in
  let add (here, found) (leg : Inline_plan.leg) (counted : Inline_plan.leg) =
    let move (here, found) towards =
      match here with
      | None -> (Some towards, found)
      | Some from ->
        let metres = Wgs84.distance from towards in
        (Some towards,
         { from; towards; seconds = metres /. leg.speed /. pace; counts = metres /. counted.speed } :: found)
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
  pace : float;
}

(* How far the tracker is from the truth at each report, in seconds of flight. *)
let track f =
  let parts = parts ~pace:f.pace ~speed:f.speed f.plan in
  let first = (List.hd parts).from and before = at f.approach in
  let coming = Wgs84.distance before first /. f.speed /. f.pace and all = sum (fun part -> part.seconds) parts in
  let gaps = Array.of_list f.gaps and errors = Array.of_list f.errors in
  let rec go i time t found =
    if time > coming +. all then List.rev found
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
  | Some t -> go 0 0. t []

(* {1 Plans} *)

let maneuver ?(unit = Plan.Metres_per_second) ~speed kind place =
  { Plan.id = ""; kind; location = at place; speed = (speed, unit); z = (2., Depth); payloads = [] }

let plan maneuvers =
  let number i (m : Plan.maneuver) = { m with id = string_of_int i } in
  Inline_plan.Maneuvers { name = "p"; description = ""; vehicles = []; maneuvers = List.mapi number maneuvers }

let goes ?unit ~speed places = plan (List.map (maneuver ?unit ~speed Go_to) places)

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
let plans ?unit ~speed () =
  let m = maneuver ?unit ~speed and goes places = goes ?unit ~speed places in
  let* place = Gen.pair (metres 300) (metres 300) and* square = Gen.bool and* seconds = Gen.int_range 5 300 in
  let* places = Gen.(list_size (int_range 2 8) (pair (metres 400) (metres 400))) in
  Gen.oneofl
    [ ("rows", plan [ m (rows ~square ()) place ]);
      ("there and back", goes [ (0., 0.); (300., 0.); (0., 0.); (300., 0.); (0., 0.) ]);
      ("a crossing", goes [ (0., 0.); (300., 300.); (300., 0.); (0., 300.); (0., 0.) ]);
      ("rounds", goes (List.concat (List.init 3 (fun _ -> [ (0., 0.); (150., 0.); (150., 150.); (0., 150.) ]))));
      ("stays", plan [ m Go_to (0., 0.); m (loiter (float_of_int seconds)) (200., 0.); m Go_to (0., 50.);
                       m (Station_keeping { radius = 10.; duration = float_of_int seconds }) (0., 100.) ]);
      ("places", goes places) ]

let flights ?unit ?(paces = [ 1. ]) ?(tells_speed = true) ~least ~most () =
  let* speed = Gen.oneofl [ 1.; 1.5; 5.; 20. ] in
  let* name, plan = plans ?unit ~speed () in
  let* approach = Gen.pair (metres 400) (metres 400) in
  (* Of a vehicle that goes on for more than 100 m unseen, reports may fit a way that it did not go. *)
  let most = Float.min most (Float.max 3. (100. /. speed)) in
  let* gaps = Gen.(list_size (int_range 1 30) (float_range least most)) in
  let* pace = Gen.oneofl paces in
  let+ errors = Gen.(list_size (int_range 1 30) (pair (float_range (-3.5) 3.5) (float_range (-3.5) 3.5))) in
  { name; plan; speed; approach; gaps; errors; tells_speed; pace }

(* 20 metres of the way and the error of a report, twice that if the speed is another or not known; or 2 seconds. A long
   silence adds a quarter of it. Where reports are far from each other, one may leave a doubt that the next settles. *)
let longest f = List.fold_left Float.max 0. f.gaps
let silence f = Float.max 0. (longest f -. 5.)

let tolerance f =
  let metres = if f.tells_speed && f.pace = 1. then 25. else 50. in
  (* It comes to a stay at some moment between two reports, and leaves it so. *)
  let unseen = if f.name = "stays" then longest f else 0. in
  Float.max 2. (metres /. f.speed /. f.pace) +. (0.25 *. silence f) +. unseen

let misses f =
  let is_miss (_, truth, believed) = Float.abs (truth -. believed) > tolerance f in
  let rec both = function
    | a :: (b :: _ as rest) -> if is_miss a && is_miss b then a :: both rest else both rest
    | [ _ ] | [] -> []
  in
  if longest f *. f.speed > 25. then both (track f) else List.filter is_miss (track f)

let print f =
  let points pp points = String.concat " " (List.map pp points) in
  let offset (north, east) = Printf.sprintf "(%.1f, %.1f)" north east in
  let miss (time, truth, believed) = Printf.sprintf "%.1f: %.1f, tracked %.1f" time truth believed in
  Printf.sprintf "%s at %g times %g m/s from %s; gaps %s; errors %s; %s\n%s" f.name f.pace f.speed (offset f.approach)
    (points (Printf.sprintf "%g") f.gaps) (points offset f.errors)
    (points (fun part -> offset (Wgs84.displacement Place.apdl part.from)) (parts ~speed:f.speed f.plan))
    (String.concat "\n" (List.filteri (fun i _ -> i < 5) (List.map miss (misses f))))

let follows f = misses f = []

let laws =
  let law what flights = Property.case ~count:200 what ~print flights follows in
  [ law "often" (flights ~least:0.5 ~most:2. ());
    law "seldom" (flights ~least:0.5 ~most:60. ());
    law "slower or faster than planned" (flights ~paces:[ 0.7; 0.85; 1.2 ] ~least:0.5 ~most:3. ());
    law "speeds in RPM" (flights ~unit:Plan.Revolutions_per_minute ~least:0.5 ~most:3. ());
    law "nothing known of its speed"
      (flights ~unit:Plan.Revolutions_per_minute ~tells_speed:false ~least:0.5 ~most:3. ()) ]

(* {1 Cases} *)

let started ?(speed = 1.) p = Option.get (Progress.start ~speed p)
let see t (time, place) = Progress.observe ~at:time (at place) t
let share = Alcotest.float 0.01
let check what expected t = Alcotest.check share what expected (Progress.share t)

(* 100 m, 100 s within a radius of 20 m, 100 m. *)
let with_stay =
  let m = maneuver ~speed:1. in
  plan [ m Go_to (0., 0.); m (loiter 100.) (100., 0.); m Go_to (200., 0.) ]

let there t = List.fold_left see t [ (0., (0., 0.)); (50., (50., 0.)); (100., (100., 0.)) ]

let cases =
  [ case "without a way" (fun () ->
        let pop_up =
          Plan.Pop_up { duration = 9.; current_position = true; wait_at_surface = true; station_keep = false } in
        let is_none p = Progress.start ~speed:1. p = None in
        Alcotest.(check bool) "no place" true (is_none (plan [ maneuver ~speed:1. pop_up (0., 0.) ]));
        let move = { Mission_plan.word = "move"; arguments = [ ("north", Number 10.) ] } in
        Alcotest.(check bool) "not fixed" true (is_none (Mission { name = "m"; vehicles = []; items = [ move ] })));
    case "nothing is done before it is there" (fun () ->
        let t = List.fold_left see (started with_stay) [ (0., (150., 0.)); (60., (90., 0.)); (130., (20., 0.)) ] in
        check "coming along the way" 0. t;
        check "there" 0. (see t (150., (0., 0.)));
        check "on the way" 0.1 (see (see t (150., (0., 0.))) (180., (30., 0.))));
    case "a vehicle that waits on the way has not begun" (fun () ->
        let wait t i = see t (float_of_int i, (60., 0.)) in
        check "seen often" 0. (List.fold_left wait (started with_stay) (List.init 600 Fun.id));
        check "seen seldom" 0. (List.fold_left wait (started with_stay) [ 0; 100; 200; 300 ]));
    case "its beginning was not seen" (fun () ->
        let t = List.fold_left see (started with_stay) [ (0., (42., -9.)); (80., (38., 0.)) ] in
        check "where it was before" 0. t;
        check "it goes away" 0.193 (see t (100., (58., 0.))));
    case "late, and nearer to its way after a stay" (fun () ->
        let m = maneuver ~speed:20. in
        let t = started ~speed:20. (plan [ m Go_to (0., 0.); m (loiter 240.) (200., 0.); m Go_to (0., 50.) ]) in
        check "before the stay" 0.019 (List.fold_left see t [ (0., (0., 0.)); (30., (100., 17.)) ]));
    case "its time counts anywhere around" (fun () ->
        let t = there (started with_stay) in
        check "arrives" 0.333 t;
        let t = see t (130., (110., 15.)) in
        check "north of it" 0.433 t;
        let t = see t (160., (80., -20.)) in
        check "south of it" 0.533 t;
        let t = see (see t (190., (120., 0.))) (220., (105., 0.)) in
        check "not longer than its time" 0.683 t);
    case "it leaves early" (fun () ->
        let t = see (there (started with_stay)) (130., (100., 5.)) in
        let t = List.fold_left see t [ (140., (110., 0.)); (170., (140., 0.)); (190., (160., 0.)) ] in
        check "seen beyond" 0.867 t);
    case "it leaves late" (fun () ->
        let t = List.fold_left (fun t i -> see t (100. +. float_of_int i, (100., 0.))) (there (started with_stay))
            (List.init 500 Fun.id) in
        check "waits" 0.667 t;
        check "goes" 0.767 (see t (640., (130., 0.))));
    case "a stay without end" (fun () ->
        let m = maneuver ~speed:1. in
        let t = started (plan [ m Go_to (0., 0.); m (loiter 0.) (100., 0.); m Go_to (200., 0.) ]) in
        let t = see (there t) (5000., (100., 5.)) in
        check "stays" 0.5 t;
        check "as long as it may be near" 0.5 (see t (5020., (120., 0.)));
        check "unless it goes on" 0.95 (see t (5090., (190., 0.))));
    case "it does not advance off its way" (fun () ->
        let t = started (goes ~speed:1. [ (0., 0.); (300., 0.); (300., 300.) ]) in
        let t = List.fold_left see t [ (0., (0., 0.)); (60., (60., 0.)) ] in
        let t = List.fold_left see t [ (200., (60., 200.)); (400., (200., 200.)) ] in
        check "off" 0.1 t;
        check "back where it left" 0.1 (see t (600., (60., 0.)));
        check "back" 0.133 (see (see t (600., (60., 0.))) (620., (80., 0.))));
    case "two reports at a time" (fun () ->
        let t = List.fold_left see (started with_stay) [ (0., (0., 0.)); (50., (50., 0.)); (50., (50., 0.)) ] in
        check "half-way" 0.167 t);
    case "a way without time" (fun () -> check "there" 0. (see (started (goes ~speed:1. [ (0., 0.) ])) (0., (0., 0.))));
    case "long ways" (fun () ->
        let place i = (float_of_int (i / 2 mod 100) *. 10., float_of_int ((i + 1) / 2 mod 2) *. 10.) in
        let places = List.init 10_000 place in
        let t = started ~speed:20. (goes ~speed:20. places) in
        let seen t i = see t (float_of_int i *. 0.5, List.nth places (i mod 100)) in
        let before = Sys.time () in
        ignore (List.fold_left seen t (List.init 10_000 Fun.id));
        let seconds = Sys.time () -. before in
        if seconds > 5. then Alcotest.failf "%.1f s for 10,000 reports" seconds) ]

let () = Alcotest.run "progress" [ ("flights", laws); ("cases", cases) ]
