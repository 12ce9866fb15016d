module Position = Dolphin_geo.Position
module Wgs84 = Dolphin_geo.Wgs84

type leg = { waypoints : Position.t list; speed : float; dwell : float }
type cut = { leg : int; passed : int; place : Position.t; stayed : float option }

let rec drop n = function _ :: xs when n > 0 -> drop (n - 1) xs | xs -> xs
let is_there p q = Wgs84.distance p q < 0.01

(* [towards] is [None] for a stay. *)
type step = { of_leg : int; reached : int; from : Position.t; towards : Position.t option; seconds : float }

let steps_of_leg (here, found) of_leg (leg : leg) =
  let move (here, reached, found) towards =
    let step from =
      let seconds = Wgs84.distance from towards /. leg.speed in
      { of_leg; reached; from; towards = Some towards; seconds }
    in
    (Some towards, reached + 1, Option.to_list (Option.map step here) @ found)
  in
  let here, reached, found = List.fold_left move (here, 0, found) leg.waypoints in
  match here with
  | Some from when Float.is_finite leg.dwell ->
    (here, { of_leg; reached; from; towards = None; seconds = leg.dwell } :: found)
  | Some _ | None -> (here, found)

let steps legs =
  let add (of_leg, found) leg = (of_leg + 1, steps_of_leg found of_leg leg) in
  let _, (_, reversed) = List.fold_left add (0, (None, [])) legs in
  List.rev reversed

let cut_at seconds step =
  let share = Float.min 1. (seconds /. step.seconds) in
  let cut place stayed = { leg = step.of_leg; passed = step.reached; place; stayed } in
  match step.towards with
  | Some towards -> cut (Wgs84.interpolate step.from towards share) None
  | None -> cut step.from (Some (share *. step.seconds))

let total steps = List.fold_left (fun sum step -> sum +. step.seconds) 0. steps
let seconds legs = total (steps legs)

let cut x legs =
  let steps = steps legs in
  let total = total steps in
  if not (x > 0. && total > 0.) then None
  else
    let wanted = Float.min 1. x *. total in
    let rec find before = function
      | [] -> None
      | step :: _ when step.seconds > 0. && before +. step.seconds >= wanted -> Some (cut_at (wanted -. before) step)
      | step :: rest -> find (before +. step.seconds) rest
    in
    find 0. steps
