open Entry
module Wgs84 = Dolphin_geo.Wgs84

let by_time a b = Float.compare a.time b.time

(* Of the samples of one place, at least one, in order of time. *)
let rec at time = function
  | [] -> invalid_arg "Sampled_field.at: no samples"
  | [ last ] -> last.value
  | first :: _ when time <= first.time -> first.value
  | first :: (next :: _ as rest) ->
    if time >= next.time then at time rest
    else first.value +. ((next.value -. first.value) *. (time -. first.time) /. (next.time -. first.time))

let rec by_place = function
  | [] -> []
  | first :: rest ->
    let here, elsewhere = List.partition (fun s -> s.place = first.place) rest in
    (first.place, List.stable_sort by_time (first :: here)) :: by_place elsewhere

(* Metres. Nearer than this is there: weights stay finite. *)
let there = 0.01

let value samples quantity position ~time =
  let places = by_place (List.filter (fun s -> s.quantity = quantity) samples) in
  let distance (place, _) = Wgs84.distance place position in
  let weigh (sum, weights) (place, samples) =
    let d = distance (place, samples) in
    let weight = 1. /. (d *. d) in
    (sum +. (weight *. at time samples), weights +. weight)
  in
  match List.find_opt (fun p -> distance p < there) places, places with
  | Some (_, samples), _ | None, [ (_, samples) ] -> Some (at time samples)
  | None, [] -> None
  | None, places ->
    let sum, weights = List.fold_left weigh (0., 0.) places in
    Some (sum /. weights)

let still_from samples = List.fold_left (fun latest s -> Float.max latest s.time) 0. samples
