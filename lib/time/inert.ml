open Dolphin_semantics
open Dolphin_environment
module Footprint = Dolphin_explore.Footprint
module Step_footprints = Dolphin_explore.Step_footprints

type t = {
  options : Clocked.options;
  possible : bool;
  code : Footprint.code;
  steps : Step_footprints.context;
  unread : string list;  (* keys *)
}

let names_are_free (o : Clocked.options) =
  let { Environment.faults; inputs; _ } = o.environment in
  let may = Faults.is_possible in
  (not (may faults.loss)) && (not (may faults.join)) && (not faults.interrupt)
  && List.for_all (fun (i : Environment.input) -> not (List.mem i.key o.program.inputs)) inputs
  && (not o.program.reads_sensors) && (not o.program.reads_now)
  && (not (Clocked.may_change_during_tasks o))
  && not (Footprint.asks_held o.program)

let create (options : Clocked.options) =
  { options; possible = names_are_free options; code = Footprint.code options.program;
    steps = Step_footprints.context options.environment options.program;
    unread = Unread_pairs.keys options.program }

type part = { event : Clocked.item; task : Core.platform_task option; least : int; most : int; follow : int }
type item = { awaited : Clocked.item; parts : part list; least : int; most : int }

let is_awaited items event = List.exists (fun i -> i.awaited = event) items
let steps i = List.fold_left (fun n p -> n + 1 + p.follow) 0 i.parts

(* Under handlers, too. *)
let rec components : Residual.t -> Residual.t list = function
  | Parallel bs -> Branches.to_list bs
  | Watch (r, _) -> components r
  | r -> [ r ]

(* More would cost too much in each state. *)
let most_rounds = 1_000

(* The next round begins as the one before ends. *)
let rec in_sequence : Residual.t -> Residual.t list = function
  | Sequence (first, later) -> List.concat_map in_sequence (first :: later)
  | Repeat { round = Some r; again = { left = Some n; until = None; each; _ } } when n <= most_rounds ->
    in_sequence r @ List.concat (List.init n (fun _ -> in_sequence each))
  | r -> [ r ]

let rec first : Residual.t -> Residual.t = function
  | Sequence (r, _) | Watch (r, _) | Repeat { round = Some r; _ } -> first r
  | r -> r

(* The event that the first part of a component waits for, if that part does nothing but end. *)
let awaited r : Clocked.item option =
  match first r with
  | Running (_, v) -> Some (Task v)
  | Idle { timer; _ } -> Some (Timer timer)
  | _ -> None

let certainly_succeeds i v (p : Core.platform_task) = not (Environment.may_fail i.options.environment v p.name)

(* Whether no error comes out of [r]. *)
let never_fails i r = not (Step_footprints.of_residual i.steps r).breaks

let rec handled i : Residual.t -> Residual.t = function
  | Watch (r, _) when never_fails i r -> handled i r
  | r ->
    Residual.map
      { part = handled i; code = Fun.id; handler = Fun.id; maker = Fun.id; value = Fun.id; term = Fun.id;
        vehicle = Fun.id } r

(* [named] is the names in each component. *)
let is_named_again v named = List.length (List.filter (String.equal v) named) > 1

let part event task : Bounds.t -> part option = function
  | Within { least; most } -> Some { event; task; least; most; follow = 0 }
  | Some_time | Never -> None

(* Apart from messages, and pairs that no code reads: no state has them. *)
let does_nothing i code =
  let f = Footprint.of_code i.code code in
  let is_unread (k, _) = List.mem k i.unread in
  let of_others = { f with posts = Footprint.Pairs.filter (fun p -> not (is_unread p)) f.posts } in
  Footprint.touches_nothing of_others && not (f.breaks || f.halts || f.remembered)

(* [parts], the latest first, if [r] may follow them; [bounds] is those of its task, if it is one of [v]. *)
let followed_by i v parts (r : Residual.t) bounds =
  let with_step = function p :: parts -> { p with follow = p.follow + 1 } :: parts | [] -> [] in
  match r, bounds with
  | Ready (p, w), Some bounds when v = Some w && certainly_succeeds i w p ->
    Option.map (fun part -> part :: with_step parts) (part (Task w) (Some p) bounds)
  | Idle { timer; seconds; _ }, _ ->
    Option.map (fun part -> part :: parts) (part (Timer timer) None (Bounds.exactly seconds))
  | Action code, _ when does_nothing i code -> Some (with_step parts)
  | _, _ -> None

(* [bounds] is those of the tasks of [later], in their order. *)
let rec all_parts i v parts bounds (later : Residual.t list) =
  match later, bounds with
  | [], _ -> Some (List.rev parts)
  | (Ready _ as r) :: later, b :: bounds ->
    Option.bind (followed_by i v parts r (Some b)) (fun parts -> all_parts i v parts bounds later)
  | r :: later, bounds -> Option.bind (followed_by i v parts r None) (fun parts -> all_parts i v parts bounds later)

let tasks = List.filter_map (function Residual.Ready (p, _) -> Some p | _ -> None)

let parts i (s : Clocked.state) named r =
  let first, later = match in_sequence r with first :: later -> (first, later) | [] -> (r, []) in
  let first_part item task =
    let pending = List.find_opt (fun (p : Clocked.pending) -> p.item = item) s.pending in
    Option.bind pending (fun p -> part item task p.bounds) in
  match first with
  | Running (p, v) when certainly_succeeds i v p && not (is_named_again v named) ->
    let bounds () = if later = [] then [] else List.tl (Clocked.in_turn i.options s v (p :: tasks later)) in
    Option.bind (first_part (Task v) (Some p)) (fun part -> all_parts i (Some v) [ part ] (bounds ()) later)
  | Idle { timer; _ } -> Option.bind (first_part (Timer timer) None) (fun part -> all_parts i None [ part ] [] later)
  | _ -> None

let item (parts : part list) =
  let sum time = List.fold_left (fun n p -> n + time p) 0 parts in
  { awaited = (List.hd parts).event; parts; least = sum (fun p -> p.least); most = sum (fun p -> p.most) }

let of_components i (s : Clocked.state) components =
  let named = List.concat_map Residual.named components in
  let items = List.filter_map (fun r -> Option.map item (parts i s named r)) components in
  List.sort (fun a b -> Stdlib.compare a.awaited b.awaited) items

let of_state i (s : Clocked.state) =
  match s.configuration.control with
  | Executing (_, r) when i.possible -> (
      match handled i r with
      | Watch _ -> []  (* an error may cut all of it off *)
      | r when Residual.makes_tasks r -> []
      | r -> of_components i s (components r))
  | Executing _ | Script _ | Waiting _ | Ended _ -> []

let is_one items r = match awaited r with Some item -> List.mem item items | None -> false

let is_rest (s : Clocked.state) items =
  match s.configuration.control with
  | Executing (_, r) -> List.for_all (is_one (List.map (fun i -> i.awaited) items)) (components r)
  | Script _ | Waiting _ | Ended _ -> false

let without items (c : Configuration.t) =
  match c.control with
  | Executing (m, r) -> (
      let ended, left = List.partition (is_one items) (components r) in
      let remove allocation r =
        match first r with Running (_, v) -> Vehicle_map.remove v allocation | _ -> allocation in
      let allocation = List.fold_left remove c.shared.allocation ended in
      match left with
      | [] -> None
      | left ->
        Some { Configuration.control = Executing (m, Residual.parallel left); shared = { c.shared with allocation } })
  | Script _ | Waiting _ | Ended _ -> Some c
