open Dolphin_results
open Core

let ( let* ) = Result.bind

let inside world (asked : Vehicle_filter.t) v =
  match asked.region with
  | None -> Ok true
  | Some area -> Result.map (Dolphin_geo.Area.contains area) (World.place world v)

let elsewhere world (s : Shared.t) (asked : Vehicle_filter.t) =
  let bound = Vehicle_set.of_list s.bound and elsewhere = { asked with region = None } in
  let accepted (v : World.vehicle_state) = Settings.accepts elsewhere v && not (Vehicle_set.mem v.id bound) in
  List.filter accepted (World.vehicles world)

let wherever world s asked = List.map (fun (v : World.vehicle_state) -> v.id) (elsewhere world s asked)

let vehicles world s asked =
  let one (v : World.vehicle_state) =
    let* inside = inside world asked v in
    Ok (if inside then [ v.id ] else [])
  in
  Results.concat_map one (elsewhere world s asked)

let fits world s asked (v : vehicle) =
  match List.find_opt (fun (state : World.vehicle_state) -> state.id = v) (elsewhere world s asked) with
  | None -> Ok false
  | Some state -> inside world asked state
