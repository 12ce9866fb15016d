open Dolphin_semantics
open Dolphin_environment
module Footprint = Dolphin_explore.Footprint

type t = { options : Clocked.options; possible : bool }

let names_are_free (o : Clocked.options) =
  let { Environment.faults; inputs; _ } = o.environment in
  let may = Faults.is_possible in
  (not (may faults.loss)) && (not (may faults.join)) && (not faults.interrupt)
  && List.for_all (fun (i : Environment.input) -> not (List.mem i.key o.program.inputs)) inputs
  && (not o.program.reads_sensors) && (not o.program.reads_now)
  && (not (Clocked.may_change_during_tasks o))
  && not (Footprint.asks_held o.program)

let create options = { options; possible = names_are_free options }

type item = { awaited : Clocked.item; least : int; most : int }

let components : Residual.t -> Residual.t list = function Parallel bs -> Branches.to_list bs | r -> [ r ]

(* Of a component that does nothing but end. *)
let only_ends : Residual.t -> Clocked.item option = function
  | Running (_, v) -> Some (Task v)
  | Idle { timer; _ } -> Some (Timer timer)
  | _ -> None

let certainly_succeeds i v (p : Core.platform_task) = not (Environment.may_fail i.options.environment v p.name)

(* [named] is the names in each component. *)
let is_named_again v named = List.length (List.filter (String.equal v) named) > 1

let of_state i (s : Clocked.state) =
  let item named r =
    match r, only_ends r with
    | Residual.Running (p, v), Some _ when is_named_again v named || not (certainly_succeeds i v p) -> None
    | _, Some awaited -> (
        match List.find_opt (fun (p : Clocked.pending) -> p.item = awaited) s.pending with
        | Some { bounds = Within { least; most }; _ } -> Some { awaited; least; most }
        | Some { bounds = Some_time | Never; _ } | None -> None)
    | _, None -> None
  in
  match s.configuration.control with
  | Executing (_, r) when i.possible && not (Residual.makes_tasks r) ->
    let components = components r in
    let named = List.concat_map Residual.named components in
    List.sort Stdlib.compare (List.filter_map (item named) components)
  | Executing _ | Script _ | Waiting _ | Ended _ -> []

let is_one items r =
  match only_ends r with Some awaited -> List.mem awaited items | None -> false

let is_rest (s : Clocked.state) items =
  match s.configuration.control with
  | Executing (_, r) -> List.for_all (is_one (List.map (fun i -> i.awaited) items)) (components r)
  | Script _ | Waiting _ | Ended _ -> false

let without items (c : Configuration.t) =
  match c.control with
  | Executing (m, r) -> (
      let ended, left = List.partition (is_one items) (components r) in
      let remove allocation : Residual.t -> _ = function
        | Running (_, v) -> Vehicle_map.remove v allocation
        | _ -> allocation
      in
      let allocation = List.fold_left remove c.shared.allocation ended in
      match left with
      | [] -> None
      | left ->
        Some { Configuration.control = Executing (m, Residual.parallel left); shared = { c.shared with allocation } })
  | Script _ | Waiting _ | Ended _ -> Some c
