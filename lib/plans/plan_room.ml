open Dolphin_geo

type part = { leg : string; is_transit : bool; stretch : Fence.stretch }

(* [before]: the place that the way has come to, if that is known, and whether the vehicle is still on its way to the
   plan. *)
let parts_of_leg (before, is_transit) (leg : Inline_plan.leg) =
  let part ~is_transit from towards radius =
    { leg = leg.named; is_transit; stretch = { Fence.from; towards; radius } } in
  let add (before, is_transit, parts) place =
    let from = Option.value before ~default:place in
    (Some place, false, part ~is_transit from place 0. :: parts)
  in
  let last, is_transit, parts = List.fold_left add (before, is_transit, []) leg.waypoints in
  let around =
    match last with
    | Some place when leg.radius > 0. -> [ part ~is_transit:false place place leg.radius ]
    | Some _ | None -> []
  in
  ((last, is_transit), List.rev_append parts around)

let parts_of_legs from legs =
  let add (before, reversed) leg =
    let after, parts = parts_of_leg before leg in
    (after, List.rev_append parts reversed)
  in
  List.rev (snd (List.fold_left add ((from, from <> None), []) legs))

(* A result that is the same from two places does not depend on the vehicle's place. *)
let anywhere p =
  match Inline_plan.reference p with
  | None -> []
  | Some here ->
    let elsewhere = Wgs84.displace here ~north:1000. ~east:700. in
    let room from = parts_of_legs (Some from) (Inline_plan.path ~from ~speed:1. p) in
    let same a b =
      a.stretch.towards = b.stretch.towards && (a.is_transit || a.stretch.from = b.stretch.from) in
    let known a b =
      let arrival () = { a with is_transit = false; stretch = { a.stretch with from = a.stretch.towards } } in
      if not (same a b) then None else if a.is_transit then Some (arrival ()) else Some a
    in
    let first = room here and second = room elsewhere in
    if List.compare_lengths first second <> 0 then []
    else List.filter_map Fun.id (List.rev (List.rev_map2 known first second))

let make ~from p =
  match from with
  | Some here -> parts_of_legs from (Inline_plan.path ~from:here ~speed:1. p)
  | None -> anywhere p

type vertical = Below_surface of float | Above of float | At_altitude of float | Not_told

let vertical_of_maneuver (m : Plan.maneuver) =
  let z, unit = m.z in
  let up, down =
    match m.kind with
    | Yo_yo { amplitude; _ } -> (amplitude /. 2., amplitude /. 2.)
    | Compass_calibration { amplitude; _ } -> (amplitude, amplitude)
    | Follow_path points ->
      let extreme f = List.fold_left (fun most (_, _, down) -> Float.max most (f down)) 0. points in
      (extreme Float.neg, extreme Fun.id)
    | Go_to | Loiter _ | Pop_up _ | Station_keeping _ | Launch | Rows _ -> (0., 0.)
  in
  match unit with
  | Plan.Depth -> Below_surface (z +. down)
  | Height -> Above (z +. up)
  | Altitude -> At_altitude (z +. up)
  | Unspecified -> Not_told

let rec verticals : Inline_plan.t -> _ = function
  | Rest r -> verticals r.plan
  | Maneuvers p -> List.map (fun (m : Plan.maneuver) -> (m.id, vertical_of_maneuver m)) p.maneuvers
  | Mission m ->
    let vertical (item, height) = (item, Option.fold height ~none:Not_told ~some:(fun metres -> Above metres)) in
    List.map vertical (Mission_plan.heights m)
