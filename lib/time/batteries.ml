open Dolphin_semantics
module Scenario = Dolphin_scenario.Scenario
module Battery = Dolphin_scenario.Battery

let seconds ms = float ms /. 1000.

type turn = { vehicle : Core.vehicle; doing : Battery.doing; at : int }

let turns options start steps dates =
  let vehicle (p : Clocked.pending) = match p.item with Task v -> Some v | _ -> None in
  let add (before, found) (step : Clocked.step) at =
    let pending = before.Clocked.pending @ step.next.pending in
    let vehicles = List.sort_uniq String.compare (List.filter_map vehicle pending) in
    let turn vehicle =
      let doing = Clocked.doing options step.next vehicle in
      if doing = Clocked.doing options before vehicle then None else Some { vehicle; doing; at }
    in
    (step.next, List.rev_append (List.filter_map turn vehicles) found)
  in
  List.rev (snd (List.fold_left2 add (start, []) steps dates))

(* Between two turns it goes one way: it is least at one of them. *)
let left (v : Scenario.vehicle) turns ~until =
  let add (b, least) turn =
    let at = seconds turn.at in
    (Battery.turn b ~at turn.doing, Float.min least (Battery.level b ~at)) in
  let b = Battery.start v in
  let turns = List.filter (fun turn -> String.equal turn.vehicle v.id) turns in
  let b, least = List.fold_left add (b, Battery.level b ~at:0.) turns in
  Float.min least (Battery.level b ~at:(seconds until))

let spans options (v : Scenario.vehicle) start steps =
  let span doing i j : Dates.span =
    if Battery.rate v doing > 0. then Short (i, j) else Long (i, j) in
  let add (k, since, before, found) (step : Clocked.step) =
    let doing s = Clocked.doing options s v.id in
    if doing before = doing step.next then (k + 1, since, step.next, found)
    else (k + 1, k, step.next, span (doing before) since k :: found)
  in
  let k, since, last, found = List.fold_left add (1, 0, start, []) steps in
  span (Clocked.doing options last v.id) since (k - 1) :: found

type way = Timed_system.edge list

(* A vehicle is not under way for longer than the run. *)
let of_end (v : Scenario.vehicle) working until =
  Battery.least v ~working:(seconds (min working until)) ~until:(seconds until)

let least system vs =
  let ends = Timed_system.ends system in
  let latest = List.filter_map (fun (n, date) -> match date with Timed_system.At ms -> Some (n, ms) | _ -> None) ends in
  let graph edges =
    let edge (e : Timed_system.edge) = (e.source, e.target, e) in
    Longest.graph (Timed_system.count system) (List.rev (List.rev_map edge edges))
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
