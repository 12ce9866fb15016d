open Dolphin_scenario

type t = {
  scenario : Scenario.vehicle;
  track : Track.t;
  since : float;                                (* when it set out on it *)
  charge : Battery.t;
}

let make (scenario : Scenario.vehicle) =
  { scenario; track = Track.stay scenario.position; since = 0.; charge = Battery.start scenario }

let scenario v = v.scenario
let empty_from v = Battery.empty_from v.charge
let battery v ~at = Battery.level v.charge ~at

let position v ~at = Track.position v.track (at -. v.since)

let speed v ~at = Track.speed v.track (at -. v.since)

(* The nearest of [xs] to [x], the first of several; [x] if [xs] is empty. *)
let nearest distance x = function
  | [] -> x
  | first :: rest -> List.fold_left (fun best y -> if distance x y < distance x best then y else best) first rest

let seen_at v ~at = nearest Dolphin_geo.Wgs84.distance (position v ~at) v.scenario.places
let shown_battery v ~at =
  if v.scenario.tells_battery then
    Some (nearest (fun a b -> Float.abs (a -. b)) (battery v ~at) v.scenario.batteries)
  else None

let set_out v ~at ~charges track =
  let doing = Option.fold charges ~none:Battery.Works ~some:(fun share -> Battery.Charges share) in
  { v with track; since = at; charge = Battery.turn v.charge ~at doing }

let rest v ~at =
  let place = position v ~at in
  let charge = Battery.turn v.charge ~at (Battery.resting_at v.scenario place) in
  { v with track = Track.stay place; since = at; charge }
let is_steady v ~at = at -. v.since >= Track.still_from v.track && Battery.is_steady v.charge ~at
