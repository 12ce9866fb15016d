open Dolphin_plans
open Dolphin_geo

type t = { centre : Position.t; within : float }

let at centre = { centre; within = 0. }
let legs from plan = Inline_plan.path ~from ~speed:1. plan

let last legs =
  let of_leg last (leg : Inline_plan.leg) = List.fold_left (fun _ p -> Some p) last leg.waypoints in
  List.fold_left of_leg None legs

(* Ways from different places end at different ones: at the place where they began, if they come home. *)
let after here plan =
  match last (legs Place.apdl plan), last (legs Place.feup plan), here with
  | None, None, _ -> here
  | Some p, Some q, _ when Position.equal p q -> Some (at p)
  | _, _, Some { centre; _ } when Inline_plan.way_from plan <> None ->
    if Option.equal Position.equal (last (legs centre plan)) (Some centre) then here else None
  | _, _, _ -> None

(* {1 Stopped on the way} *)

let reach { centre; within = _ } (p, radius) = Wgs84.distance centre p +. radius
let covers here places = List.for_all (fun place -> reach here place <= here.within) places

(* Not the least circle, which would take longer to find: its centre is that of the box around all places. *)
let around here places =
  let all = (here.centre, here.within) :: places in
  let middle of_place =
    let values = List.map (fun (p, _) -> of_place p) all in
    (List.fold_left Float.min infinity values +. List.fold_left Float.max neg_infinity values) /. 2. in
  let latitude = middle (fun (p : Position.t) -> p.latitude) and longitude = middle (fun p -> p.longitude) in
  let centre = { here.centre with latitude; longitude } in
  { centre; within = List.fold_left (fun most place -> Float.max most (reach (at centre) place)) 0. all }

(* What stays where it is may move around there. *)
let along here plan =
  match here, Inline_plan.way_from plan with
  | Some here, Some _ ->
    let of_leg (from, places) (leg : Inline_plan.leg) =
      match List.rev leg.waypoints with
      | [] -> (from, (from, leg.radius) :: places)
      | last :: _ -> (last, List.map (fun p -> (p, leg.radius)) leg.waypoints @ places)
    in
    let _, places = List.fold_left of_leg (here.centre, []) (legs here.centre plan) in
    Some (if covers here places then here else around here places)
  | Some _, None | None, _ -> None

(* {1 On the way} *)

(* A stretch between a place that is fixed and one that lies as far from the centre as the vehicle is longer or shorter
   by that. A second way from another place shows which places are fixed. *)
let moving here ~speed ~pace plan =
  let stretch (leg : Inline_plan.leg) (least, most, p, q) (p', q') =
    let metres = Wgs84.distance p p' in
    let doubt = if Position.equal p q = Position.equal p' q' then 0. else here.within in
    let add total metres = if metres > 0. then total +. (metres /. pace leg) else total in
    (add least (metres -. doubt), add most (metres +. doubt), p', q')
  in
  let rec go ((least, most, _, _) as found) = function
    | (leg : Inline_plan.leg) :: legs, (leg' : Inline_plan.leg) :: legs' ->
      if List.compare_lengths leg.waypoints leg'.waypoints <> 0 then None
      else
        let found = List.fold_left2 (fun found p q -> stretch leg found (p, q)) found leg.waypoints leg'.waypoints in
        if leg.dwell = infinity then go found ([], []) else go found (legs, legs')
    | [], [] -> Some (least, most)
    | _ :: _, [] | [], _ :: _ -> None
  in
  let path from = Inline_plan.path ~from ~speed plan in
  let between other = go (0., 0., here.centre, other) (path here.centre, path other) in
  if here.within = 0. then between here.centre
  else if Inline_plan.way_from plan = None then None
  else between (if Position.equal here.centre Place.apdl then Place.feup else Place.apdl)
