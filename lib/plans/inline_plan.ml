module Position = Dolphin_geo.Position

type t = Maneuvers of Plan.t | Mission of Mission_plan.t

let name = function Maneuvers p -> p.name | Mission m -> m.name
let vehicles = function Maneuvers p -> p.vehicles | Mission m -> m.vehicles
let required_payload = function Maneuvers p -> Plan.required_payload p | Mission m -> Mission_plan.required_payload m
let reference = function Maneuvers p -> Plan.reference p | Mission m -> Mission_plan.reference m

type leg = {
  named : string;
  waypoints : Position.t list;
  level : Plan.level;
  speed : float;
  dwell : float;
  radius : float;
}

let path ~from ~speed = function
  | Maneuvers p ->
    let leg (m : Plan.maneuver) ({ maneuver = named; waypoints; level; dwell; radius } : Plan.leg) =
      let metres = Plan.metres_per_second m ~default:speed in
      { named; waypoints; level; dwell; speed = (if metres > 0. then metres else speed); radius }
    in
    List.rev (List.rev_map2 leg p.maneuvers (Plan.path p))
  | Mission m ->
    List.map
      (fun ({ item = named; waypoints; level; dwell; speed; radius } : Mission_plan.leg) ->
         { named; waypoints; level; dwell; speed; radius })
      (Mission_plan.path ~from ~speed m)

let is_stay leg = leg.waypoints = []

let is_fixed p =
  let places from = List.concat_map (fun leg -> leg.waypoints) (path ~from ~speed:1. p) in
  List.equal Position.equal (places Dolphin_geo.Place.apdl) (places Dolphin_geo.Place.feup)

type extent = { metres : float; moving : float; staying : float }

let extent ~from ~speed p =
  let stretch speed (here, e) towards =
    let metres = Dolphin_geo.Wgs84.distance here towards in
    let moving = if metres = 0. then e.moving else e.moving +. (metres /. speed) in
    (towards, { e with metres = e.metres +. metres; moving })
  in
  let leg (here, e) (leg : leg) =
    if e.staying = infinity then (here, e)
    else
      let here, e = List.fold_left (stretch leg.speed) (here, e) leg.waypoints in
      (here, { e with staying = e.staying +. leg.dwell })
  in
  snd (List.fold_left leg (from, { metres = 0.; moving = 0.; staying = 0. }) (path ~from ~speed p))

let start p =
  let first leg = match leg.waypoints with place :: _ -> Some (place, leg.speed) | [] -> None in
  if is_fixed p then List.find_map first (path ~from:Dolphin_geo.Place.apdl ~speed:nan p) else None

let from_share x p =
  if not (x > 0. && is_fixed p) then p
  else
    match p with
    | Maneuvers p -> Maneuvers (Plan_rest.from_share x p)
    | Mission m -> Mission (Mission_rest.from_share x m)

let compare a b =
  match a, b with
  | Maneuvers p, Maneuvers q -> Plan.compare p q
  | Mission m, Mission n -> Mission_plan.compare m n
  | Maneuvers _, Mission _ -> -1
  | Mission _, Maneuvers _ -> 1

let pp ppf = function Maneuvers p -> Plan.pp ppf p | Mission m -> Mission_plan.pp ppf m
