open Dolphin_semantics
open Dolphin_geo
module Scenario = Dolphin_scenario.Scenario

type t = {
  task : Core.vehicle -> Position.t option -> Core.platform_task -> Bounds.t;
  announced : Bounds.t;
  silence : Bounds.t;
  posted : string -> Bounds.t;
  place : Core.vehicle -> Position.t option;
}

let tolerance = 0.1

(* Where a way ends depends on where it begins if ways from different places end at different ones. *)
let moves (p : Core.platform_task) =
  let last place (leg : Inline_plan.leg) = List.fold_left (fun _ waypoint -> Some waypoint) place leg.waypoints in
  let ends plan from = List.fold_left last None (Inline_plan.path ~from ~speed:1. plan) in
  match p.plan with
  | None -> None
  | Some plan -> (
      match ends plan Place.apdl, ends plan Place.feup with
      | None, None -> None
      | Some here, Some there when Position.equal here there -> Some (Some here)
      | (Some _ | None), (Some _ | None) -> Some None)

(* {1 Inline plans} *)

(* Seconds under way and seconds of staying, along a way that begins at [from]; [None]: from an unknown place. *)
let along (v : Scenario.vehicle) from plan =
  let stretch speed (here, seconds) towards =
    let metres = match here with Some here -> Wgs84.distance here towards | None -> nan in
    (Some towards, seconds +. (metres /. speed))
  in
  let leg (here, moving, staying) (leg : Inline_plan.leg) =
    let here, moving = List.fold_left (stretch leg.speed) (here, moving) leg.waypoints in
    (here, moving, staying +. leg.dwell)
  in
  let path = Inline_plan.path ~from:(Option.value from ~default:Place.apdl) ~speed:v.speed plan in
  let _, moving, staying = List.fold_left leg (from, 0., 0.) path in
  (moving, staying)

let inline v from plan =
  let moving, staying = along v from plan in
  if Float.is_nan moving then if staying = infinity then Bounds.Never else Bounds.Some_time
  else Bounds.between ((moving *. (1. -. tolerance)) +. staying) ((moving *. (1. +. tolerance)) +. staying)

(* {1 Fleets} *)

(* The simulator's, and the usual one of links: see docs/language.md. *)
let announced = 10.
let silence = 60.

let of_scenario (s : Scenario.t) =
  let vehicle id = List.find_opt (fun (v : Scenario.vehicle) -> v.id = id) s.vehicles in
  let task id from (p : Core.platform_task) =
    let entry = Scenario.plan s p.name in
    let is_refused = match entry, vehicle id with Some plan, Some v -> not (Scenario.knows plan v) | _ -> false in
    match p.plan, vehicle id, entry with
    | _ when is_refused -> Bounds.at_once
    | Some plan, Some v, _ -> inline v from plan
    | None, _, Some { duration = Some { least; most }; _ } -> Bounds.between least most
    | None, _, (Some { duration = None; _ } | None) | Some _, None, _ -> Bounds.Some_time
  in
  let posted key : Bounds.t =
    match List.filter (fun (i : Scenario.input) -> i.key = key) s.inputs with
    | [ { after = Some seconds; _ } ] -> Bounds.exactly seconds
    | _ -> Some_time
  in
  let place id = Option.map (fun (v : Scenario.vehicle) -> v.position) (vehicle id) in
  { task; announced = Bounds.exactly announced; silence = Bounds.exactly silence; posted; place }
