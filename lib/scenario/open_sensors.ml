open Dolphin_semantics

(* Its battery, speed, link and progress show anything. *)
let of_vehicle v ~places ~batteries world =
  let world = World.open_position v places (World.open_battery v batteries world) in
  let world = World.open_sensor Progress v [] world in
  World.open_sensor Connected v [ Boolean true; Boolean false ] (World.open_sensor Speed v [] world)

let of_entry world (v : Entry.vehicle) =
  let measurement world (name, xs) =
    let several = match xs with [ _ ] -> [] | xs -> List.map (fun x -> Core.Number x) xs in
    World.open_sensor (Measurement name) v.id several world
  in
  List.fold_left measurement (of_vehicle v.id ~places:v.places ~batteries:v.batteries world) v.shows
