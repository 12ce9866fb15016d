module Position = Dolphin_geo.Position
module Wgs84 = Dolphin_geo.Wgs84

(* {1 Identifiers} *)

let message : Plan.kind -> string = function
  | Go_to -> "Goto"
  | Loiter _ -> "Loiter"
  | Yo_yo _ -> "YoYo"
  | Pop_up _ -> "PopUp"
  | Station_keeping _ -> "StationKeeping"
  | Compass_calibration _ -> "CompassCalibration"
  | Launch -> "Launch"
  | Rows _ -> "Rows"
  | Follow_path _ -> "FollowPath"

(* Identifiers that a program gives stay; others are a number, a dot and a message of IMC. *)
let is_given id =
  let is_digit c = '0' <= c && c <= '9' in
  match String.split_on_char '.' id with
  | number :: _ :: _ -> not (number <> "" && String.for_all is_digit number)
  | [ _ ] | [] -> id <> ""

let numbered maneuvers =
  let number i (m : Plan.maneuver) =
    if is_given m.id then m else { m with id = Printf.sprintf "%d.%s" (i + 1) (message m.kind) } in
  List.rev (snd (List.fold_left (fun (i, found) m -> (i + 1, number i m :: found)) (0, []) maneuvers))

(* {1 The maneuver that was cut} *)

(* Altitudes count from the height of a maneuver's location. *)
let located (m : Plan.maneuver) (place : Position.t) = { place with height = m.location.height }

let go_to (m : Plan.maneuver) place = { m with id = ""; kind = Go_to; location = located m place }

(* The limit of a point of [followPath], which the points of rows may exceed. *)
let longest = 100_000.

let lowered (m : Plan.maneuver) down =
  match m.z with
  | z, Depth -> { m with z = (Float.max 0. (z +. down), Plan.Depth) }
  | z, Altitude -> { m with z = (Float.max 0. (z -. down), Plan.Altitude) }
  | z, Height -> { m with z = (z -. down, Plan.Height) }
  | _, Unspecified -> m

(* From [place] on; each of [points] has its metres below the maneuver's [z]. *)
let through (m : Plan.maneuver) place points =
  let point (towards, down) =
    let north, east = Wgs84.displacement place towards in
    (north, east, down)
  in
  let is_near (north, east, _) = Float.abs north <= longest && Float.abs east <= longest in
  let offsets = List.rev (List.rev_map point points) in
  if List.for_all is_near offsets then [ { m with kind = Follow_path offsets; location = located m place } ]
  else List.rev (List.rev_map (fun (towards, down) -> go_to (lowered m down) towards) points)

let on_the_way (m : Plan.maneuver) (leg : Plan.leg) (cut : Way.cut) =
  let downs =
    match m.kind with
    | Follow_path points -> List.map (fun (_, _, down) -> down) points
    | Go_to | Loiter _ | Yo_yo _ | Pop_up _ | Station_keeping _ | Compass_calibration _ | Launch | Rows _ ->
      List.map (fun _ -> 0.) leg.waypoints
  in
  match m.kind, Way.drop cut.passed (List.combine leg.waypoints downs) with
  | (Rows _ | Follow_path _), ((next, down) :: _ as points) ->
    let points = if Way.is_there cut.place next then points else (cut.place, down) :: points in
    through m cut.place points
  | _, (next, _) :: _ when Way.is_there cut.place next -> [ m ]
  | _, _ -> [ go_to m cut.place; m ]

(* Seconds are whole, and 0 would be without end. *)
let staying (m : Plan.maneuver) place left =
  let duration = Float.ceil (left -. 1e-6) in
  let at_its_place kind = [ { m with kind } ] in
  if duration < 1. then [ go_to m place ]
  else
    match m.kind with
    | Loiter l -> at_its_place (Loiter { l with duration })
    | Station_keeping s -> at_its_place (Station_keeping { s with duration })
    | Compass_calibration c -> at_its_place (Compass_calibration { c with duration })
    | Pop_up ({ current_position = true; _ } as p) -> [ go_to m place; { m with kind = Pop_up { p with duration } } ]
    | Pop_up p -> at_its_place (Pop_up { p with duration })
    | Go_to | Yo_yo _ | Launch | Rows _ | Follow_path _ -> [ m ]

(* {1 The rest} *)

(* A vehicle that was launched may have come back in the meantime: it is launched to the cut. *)
let launch place before =
  let is_launch (m : Plan.maneuver) = m.kind = Launch in
  match List.find_opt is_launch (List.rev before) with
  | Some m -> [ { m with id = ""; location = located m place } ]
  | None -> []

let from_share x (p : Plan.t) =
  let legs = Plan.path p in
  let leg (m : Plan.maneuver) (leg : Plan.leg) =
    let speed = Plan.metres_per_second m ~default:1. in
    { Way.waypoints = leg.waypoints; speed = (if speed > 0. then speed else 1.); dwell = leg.dwell }
  in
  match Way.cut x (List.rev (List.rev_map2 leg p.maneuvers legs)) with
  | None -> p
  | Some cut ->
    let before = List.filteri (fun i _ -> i < cut.leg) p.maneuvers in
    let m = List.nth p.maneuvers cut.leg and leg = List.nth legs cut.leg in
    let rest =
      match cut.stayed with
      | Some seconds -> staying m cut.place (leg.dwell -. seconds)
      | None -> on_the_way m leg cut
    in
    { p with maneuvers = numbered (launch cut.place before @ rest @ Way.drop (cut.leg + 1) p.maneuvers) }
