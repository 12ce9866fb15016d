open Dolphin_scenario

type t = {
  scenario : Scenario.vehicle;
  track : Track.t;
  since : float;                                (* when it set out on it *)
  battery : float;                              (* then *)
  rate : float;                                 (* what it gains a second *)
}

let hour = 3600.

(* At rest most devices are off. *)
let at_rest = 0.25

let working (scenario : Scenario.vehicle) = -.scenario.drain /. hour

let resting (scenario : Scenario.vehicle) =
  if scenario.charge > 0. then scenario.charge /. hour else at_rest *. working scenario

let make (scenario : Scenario.vehicle) =
  { scenario; track = Track.stay scenario.position; since = 0.; battery = scenario.battery; rate = resting scenario }

let scenario v = v.scenario

let empty_from v =
  if v.battery <= 0. && v.rate <= 0. then v.since
  else if v.rate < 0. then v.since -. (v.battery /. v.rate)
  else infinity

let full_from v = if v.rate > 0. then v.since +. ((1. -. v.battery) /. v.rate) else infinity

let battery v ~at =
  if at >= empty_from v then 0.
  else if at >= full_from v then 1.
  else Float.max 0. (Float.min 1. (v.battery +. (v.rate *. (at -. v.since))))

let position v ~at = Track.position v.track (at -. v.since)

let speed v ~at = Track.speed v.track (at -. v.since)

(* The nearest of [xs] to [x], the first of several; [x] if there are none. *)
let nearest distance x = function
  | [] -> x
  | first :: rest -> List.fold_left (fun best y -> if distance x y < distance x best then y else best) first rest

let seen_at v ~at = nearest Dolphin_geo.Wgs84.distance (position v ~at) v.scenario.places
let shown_battery v ~at =
  if v.scenario.tells_battery then
    Some (nearest (fun a b -> Float.abs (a -. b)) (battery v ~at) v.scenario.batteries)
  else None

let go v ~at track rate = { v with track; since = at; battery = battery v ~at; rate }
let set_out v ~at track = go v ~at track (working v.scenario)
let rest v ~at = go v ~at (Track.stay (position v ~at)) (resting v.scenario)

let is_steady v ~at =
  at -. v.since >= Track.still_from v.track && (v.rate = 0. || at >= empty_from v || at >= full_from v)
