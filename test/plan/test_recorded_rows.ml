open Dolphin_plans
module Wgs84 = Dolphin_geo.Wgs84

let case name run = Alcotest.test_case name `Quick run

(* {1 What was recorded} *)

type sample = { time : float; north : float; east : float }

let samples name =
  let channel = open_in "data/dune-rows.csv" in
  let rec read found =
    match input_line channel with
    | exception End_of_file -> close_in channel; List.rev found
    | line -> (
        match String.split_on_char ',' line with
        | [ plan; time; north; east ] when plan = name ->
          let number = float_of_string in
          read ({ time = number time; north = number north; east = number east } :: found)
        | _ -> read found)
  in
  read []

(* {1 What is planned} *)

let place = Dolphin_geo.Place.apdl

let rows ?(right = true) ?(bearing = 0.) ?(cross_angle = 0.) ?(alternation = 100.) ?(square_curve = true) () =
  let kind =
    Plan.Rows
      { bearing; cross_angle; width = 60.; length = 80.; horizontal_step = 20.; curve_offset = 5.; alternation;
        square_curve; first_curve_right = right }
  in
  { Plan.id = "1.Rows"; kind; location = place; speed = (1.5, Metres_per_second); z = (0., Depth); payloads = [] }

let plan maneuver =
  Inline_plan.Maneuvers { name = "p"; description = ""; vehicles = []; maneuvers = [ maneuver ] }

let corners maneuver =
  let legs = Inline_plan.path ~from:place ~speed:1. (plan maneuver) in
  let relative p =
    let metres = Wgs84.distance place p and bearing = Dolphin_geo.Angle.radians (Wgs84.bearing place p) in
    (metres *. cos bearing, metres *. sin bearing)
  in
  List.concat_map (fun (leg : Inline_plan.leg) -> List.map relative leg.waypoints) legs

(* {1 Beside each other} *)

let distance (x, y) (x', y') = Float.hypot (x -. x') (y -. y')

(* From [p] to the straight line between [a] and [b]. *)
let off p (a, b) =
  let x, y = a and x', y' = b in
  let along = (x' -. x, y' -. y) in
  let squared = (fst along *. fst along) +. (snd along *. snd along) in
  let share = (((fst p -. x) *. fst along) +. ((snd p -. y) *. snd along)) /. Float.max squared 1e-9 in
  let share = Float.max 0. (Float.min 1. share) in
  distance p (x +. (share *. fst along), y +. (share *. snd along))

let rec parts = function a :: (b :: _ as rest) -> (a, b) :: parts rest | [ _ ] | [] -> []
let nearest f xs = List.fold_left (fun least x -> Float.min least (f x)) infinity xs
let farthest f xs = List.fold_left (fun most x -> Float.max most (f x)) 0. xs

(* From when the vehicle is on the first row. *)
let rec on_the_way first = function
  | s :: rest when off (s.north, s.east) first > 1. -> on_the_way first rest
  | samples -> samples

(* The vehicle turns in a bend of some 5 m, and between two samples it goes 7.5 m. *)
let check name maneuver () =
  let way = corners maneuver in
  let first_row = match parts way with _ :: row :: _ -> row | _ -> Alcotest.fail "no rows" in
  let flown = on_the_way first_row (samples name) in
  let point s = (s.north, s.east) in
  Alcotest.(check bool) "most of it was recorded" true (List.length flown > 40);
  let off_the_way = farthest (fun s -> nearest (off (point s)) (parts way)) flown in
  if off_the_way > 4. then Alcotest.failf "the vehicle was %.1f m off the way" off_the_way;
  let sum = List.fold_left (fun sum s -> sum +. nearest (off (point s)) (parts way)) 0. flown in
  let on_average = sum /. float_of_int (List.length flown) in
  if on_average > 0.5 then Alcotest.failf "the vehicle was %.2f m off the way on average" on_average;
  let passed = parts (List.map point flown) in
  let missed = farthest (fun corner -> nearest (off corner) passed) (List.tl (List.tl way)) in
  if missed > 8. then Alcotest.failf "a corner was passed at %.1f m" missed

(* Until it has arrived at the last corner; it stays there. The tolerance is that of [dolphin time], and when something
   happened is known to 5 s. The vehicle is too fast in the first minute: 1.8 m/s. *)
let takes name maneuver () =
  let way = corners maneuver in
  let first_row = match parts way with _ :: row :: _ -> row | _ -> Alcotest.fail "no rows" in
  let last = List.nth way (List.length way - 1) in
  let flown = on_the_way first_row (samples name) in
  let begins = List.hd flown in
  let ends = List.find (fun s -> distance (s.north, s.east) last < 4.) flown in
  let start = Wgs84.displace place ~north:begins.north ~east:begins.east in
  let rest = { maneuver with Plan.kind = Follow_path (List.map (fun (n, e) -> (n, e, 0.)) (List.tl (List.tl way))) } in
  let planned = (Inline_plan.extent ~from:start ~speed:1. (plan rest)).moving in
  let took = ends.time -. begins.time in
  if Float.abs (took -. planned) > (0.1 *. planned) +. 5. then Alcotest.failf "%s: planned %.0f s, took %.0f s" name planned took

let recorded =
  [ ("left", rows ~right:false ()); ("right", rows ()); ("turned", rows ~bearing:45. ~cross_angle:20. ());
    ("alternation", rows ~alternation:50. ~square_curve:false ()) ]

let () =
  let all f = List.map (fun (name, maneuver) -> case name (f name maneuver)) in
  Alcotest.run "recorded rows" [
    ("the way", all check recorded);
    (* The fourth recording breaks off before the end. *)
    ("its duration", all takes (List.filter (fun (name, _) -> name <> "alternation") recorded));
  ]
