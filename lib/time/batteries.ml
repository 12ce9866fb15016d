open Dolphin_semantics
module Scenario = Dolphin_scenario.Scenario
module Battery = Dolphin_scenario.Battery

let seconds ms = float ms /. 1000.

let changes (v : Scenario.vehicle) (t : Transition.t) =
  let is_over = match t.label with Done (w, _) | Fail (w, _, _) -> w = v.id | _ -> false in
  let is_stopped = List.exists (function Effect.Stop w -> w = v.id | _ -> false) t.effects in
  let starts = List.exists (function Effect.Start (w, _) -> w = v.id | _ -> false) t.effects in
  (is_over || is_stopped, starts)

(* Between two changes it goes one way: it is least at one of them. *)
let left (v : Scenario.vehicle) steps dates =
  let change (b, least) (t : Transition.t) date =
    let at = seconds date in
    let is_over, starts = changes v t in
    let b' = if is_over then Battery.rest b ~at else b in
    ((if starts then Battery.set_out b' ~at else b'), Float.min least (Battery.level b ~at))
  in
  let b = Battery.start v in
  snd (List.fold_left2 change (b, Battery.level b ~at:0.) steps dates)

let spans v steps =
  let span under_way i j : Dates.span =
    if Battery.rate v ~under_way > 0. then Short (i, j) else Long (i, j) in
  let turn (k, since, under_way, found) t =
    let is_over, starts = changes v t in
    if is_over || starts then (k + 1, k, starts, span under_way since k :: found) else (k + 1, since, under_way, found)
  in
  let k, since, under_way, found = List.fold_left turn (1, 0, false, []) steps in
  span under_way since (k - 1) :: found

type way = Timed_system.edge list

(* A vehicle is not under way for longer than the run. *)
let of_end (v : Scenario.vehicle) working until =
  Battery.least v ~working:(seconds (min working until)) ~until:(seconds until)

let least system vs =
  let ends = Timed_system.ends system in
  let latest = List.filter_map (fun (n, date) -> match date with Timed_system.At ms -> Some (n, ms) | _ -> None) ends in
  let graph edges =
    let edge (e : Timed_system.edge) = (e.source, e.target, e) in
    Longest.graph (Timed_system.count system) (List.map edge edges)
  in
  let graph = Option.bind (Timed_system.edges system) graph in
  let of_vehicle (v : Scenario.vehicle) =
    let working (e : Timed_system.edge) = Option.value (List.assoc_opt v.id e.working) ~default:0 in
    let ways = Option.map (fun g -> Longest.ways g working) graph in
    let at_end (n, until) =
      let working = match ways with Some (longest, _) -> longest.(n) | None -> Working.unknown in
      (of_end v working until, n)
    in
    match List.sort Stdlib.compare (List.map at_end latest) with
    | [] -> None
    | (least, n) :: _ -> Some (v, Float.max 0. least, Option.map (fun (_, way) -> way n) ways)
  in
  if List.compare_lengths latest ends < 0 then [] else List.filter_map of_vehicle vs
