module Position = Dolphin_geo.Position

type t = Maneuvers of Plan.t | Mission of Mission_plan.t | Rest of { whole : t; share : float option; plan : t }

let rec name = function Maneuvers p -> p.name | Mission m -> m.name | Rest r -> name r.plan
let rec vehicles = function Maneuvers p -> p.vehicles | Mission m -> m.vehicles | Rest r -> vehicles r.plan

let rec required_payload = function
  | Maneuvers p -> Plan.required_payload p
  | Mission m -> Mission_plan.required_payload m
  | Rest r -> required_payload r.whole

let rec reference = function
  | Maneuvers p -> Plan.reference p
  | Mission m -> Mission_plan.reference m
  | Rest r -> reference r.whole

type leg = {
  named : string;
  waypoints : Position.t list;
  level : Plan.level;
  speed : float;
  dwell : float;
  radius : float;
}

let rec path ~from ~speed = function
  | Rest r -> path ~from ~speed r.plan
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

let rec way_from = function
  | Rest r -> way_from r.plan
  | (Maneuvers _ | Mission _) as p when is_fixed p -> Some Dolphin_geo.Place.apdl
  | Maneuvers _ -> None
  | Mission m -> Mission_plan.last_before_home m

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

let digest p = Digest.to_hex (Digest.string (Marshal.to_string p [ Marshal.No_sharing ]))
let rank = function Maneuvers _ -> 0 | Mission _ -> 1 | Rest _ -> 2

let rec compare a b =
  match a, b with
  | Maneuvers p, Maneuvers q -> Plan.compare p q
  | Mission m, Mission n -> Mission_plan.compare m n
  | Rest r, Rest r' ->
    let c = compare r.whole r'.whole in
    let c = if c <> 0 then c else Option.compare Float.compare r.share r'.share in
    if c <> 0 then c else compare r.plan r'.plan
  | (Maneuvers _ | Mission _ | Rest _), _ -> Int.compare (rank a) (rank b)

let rec pp ppf = function
  | Maneuvers p -> Plan.pp ppf p
  | Mission m -> Mission_plan.pp ppf m
  | Rest r -> pp ppf r.plan

let whole = function Rest r -> r.whole | (Maneuvers _ | Mission _) as p -> p
let begun p = (digest (whole p), match p with Rest r -> r.share | Maneuvers _ | Mission _ -> Some 0.)

let rec without x ~from = function
  | Maneuvers p -> Maneuvers (Plan_rest.from_share x p)
  | Mission m -> Mission (Mission_rest.from_share x ~from m)
  | Rest r -> without x ~from r.plan

(* A plan that is begun again as a whole is no rest. *)
let from_share x p =
  let rest whole ~begun plan from =
    let left = without x ~from plan in
    if compare left plan = 0 then p
    else Rest { whole; share = Some (begun +. ((1. -. begun) *. Float.min x 1.)); plan = left }
  in
  match p, way_from p with
  | Rest { share = None; _ }, _ | _, None -> p
  | _, Some _ when not (x > 0.) -> p
  | Rest { whole; share = Some begun; plan }, Some from -> rest whole ~begun plan from
  | (Maneuvers _ | Mission _), Some from -> rest p ~begun:0. p from

let some_rest = function
  | Rest r -> Rest { r with share = None }
  | (Maneuvers _ | Mission _) as p -> Rest { whole = p; share = None; plan = p }

let any_part p =
  let nothing : Plan.t = { name = ""; description = ""; vehicles = []; maneuvers = [] } in
  Rest { whole = whole p; share = None; plan = Maneuvers nothing }
