open Dolphin_plans
open Dolphin_semantics
open Dolphin_geo
module Scenario = Dolphin_scenario.Scenario

type t = {
  task : Core.vehicle -> Whereabouts.t option -> Core.platform_task -> Bounds.t;
  announced : Bounds.t;
  silence : Bounds.t;
  posted : string -> Bounds.t;
  place : Core.vehicle -> Whereabouts.t option;
  links : Links.t;
  charges : string -> float option;
  has_chargers : Core.vehicle -> bool;
}

let tolerance = 0.1

let moves (p : Core.platform_task) =
  let goes (leg : Inline_plan.leg) = not (Inline_plan.is_stay leg) in
  match p.plan with
  | None -> false
  | Some plan -> List.exists goes (Inline_plan.path ~from:Place.apdl ~speed:1. plan)

(* {1 Inline plans} *)

(* From an unknown place, the duration of a way is unknown. A rest that is not known is of no time at least. At most it
   goes as far as the whole, for the way to the place of its cut is no longer than by the first place; but all of it
   perhaps at the lowest of the speeds, at which that place is gone to. *)
let inline (v : Scenario.vehicle) from (plan : Inline_plan.t) : Bounds.t =
  let here = Option.fold from ~none:Place.apdl ~some:(fun (here : Whereabouts.t) -> here.centre) in
  let { Inline_plan.staying; _ } = Inline_plan.extent ~from:here ~speed:v.speed plan in
  let goes =
    List.filter (fun leg -> not (Inline_plan.is_stay leg)) (Inline_plan.path ~from:here ~speed:v.speed plan) in
  let between least most =
    Bounds.between ((least *. (1. -. tolerance)) +. staying) ((most *. (1. +. tolerance)) +. staying) in
  let slowest = List.fold_left (fun least (leg : Inline_plan.leg) -> Float.min least leg.speed) infinity goes in
  let is_open = match plan with Rest { share = None; _ } -> true | Rest _ | Maneuvers _ | Mission _ -> false in
  let pace (leg : Inline_plan.leg) = if is_open then slowest else leg.speed in
  match from with
  | _ when goes = [] -> between 0. 0.
  | None -> if staying = infinity then Never else Some_time
  | Some here -> (
      match Whereabouts.moving here ~speed:v.speed ~pace plan with
      | None -> if staying = infinity then Never else Some_time
      | Some (_, most) when is_open -> Bounds.from_the_start (between 0. most)
      | Some (least, most) -> between least most)

(* {1 Fleets} *)

let links_with (faults : Dolphin_environment.Faults.t) d =
  let is_possible = Dolphin_environment.Faults.is_possible in
  if is_possible faults.join then Links.none
  else if is_possible faults.loss && Links.count d.links > 0 then Links.only_first d.links
  else d.links

(* The simulator's, and the usual one of links: see docs/language.md. *)
let announced = 10.
let silence = 60.

let of_scenario (s : Scenario.t) =
  let vehicles = Hashtbl.create 16 in
  List.iter (fun (v : Scenario.vehicle) -> Hashtbl.replace vehicles v.id v) s.vehicles;
  let vehicle = Hashtbl.find_opt vehicles in
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
  let place id = Option.map (fun (v : Scenario.vehicle) -> Whereabouts.at v.position) (vehicle id) in
  let links = Links.of_silences (List.map (fun (v : Scenario.vehicle) -> (v.id, Scenario.silences v)) s.vehicles) in
  let has_chargers id = Option.fold (vehicle id) ~none:false ~some:(fun (v : Scenario.vehicle) -> v.chargers <> []) in
  let charges name = Option.bind (Scenario.plan s name) (fun (p : Scenario.plan) -> p.charges) in
  { task; announced = Bounds.exactly announced; silence = Bounds.exactly silence; posted; place; links; charges;
    has_chargers }
