module Position = Dolphin_geo.Position

type t = Maneuvers of Plan.t | Mission of Mission_plan.t

let name = function Maneuvers p -> p.name | Mission m -> m.name
let vehicles = function Maneuvers p -> p.vehicles | Mission m -> m.vehicles
let required_payload = function Maneuvers p -> Plan.required_payload p | Mission m -> Mission_plan.required_payload m
let reference = function Maneuvers p -> Some (Plan.reference p) | Mission m -> Mission_plan.reference m

type leg = { named : string; waypoints : Position.t list; speed : float; dwell : float }

let path ~from ~speed = function
  | Maneuvers p ->
    let leg (m : Plan.maneuver) ({ maneuver = named; waypoints; dwell } : Plan.leg) =
      let metres = Plan.metres_per_second m ~default:speed in
      { named; waypoints; dwell; speed = (if metres > 0. then metres else speed) }
    in
    List.rev (List.rev_map2 leg p.maneuvers (Plan.path p))
  | Mission m ->
    List.map
      (fun ({ item = named; waypoints; dwell; speed } : Mission_plan.leg) -> { named; waypoints; dwell; speed })
      (Mission_plan.path ~from ~speed m)

let compare a b =
  match a, b with
  | Maneuvers p, Maneuvers q -> Plan.compare p q
  | Mission m, Mission n -> Mission_plan.compare m n
  | Maneuvers _, Mission _ -> -1
  | Mission _, Maneuvers _ -> 1

let pp ppf = function Maneuvers p -> Plan.pp ppf p | Mission m -> Mission_plan.pp ppf m
