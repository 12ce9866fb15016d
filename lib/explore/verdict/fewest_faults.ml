open Dolphin_semantics
open Dolphin_environment
module Limits = Dolphin_checker.Limits

let violated (found : Search.outcome) =
  let run (property, (verdict : Search.verdict)) =
    match verdict with
    | Violated run -> Some (property, run)
    | Holds | Holds_if _ | By_design _ | Unreached _ | Inconclusive _ -> None
  in
  List.filter_map run found.verdicts

(* [options] that ask only for [properties]. *)
let asking properties (options : Search.options) =
  let is_asked property = List.mem property properties in
  { options with
    properties = List.filter is_asked options.properties;
    invariants = List.filter (fun i -> is_asked (Property.Invariant (Condition.to_string i))) options.invariants;
    formulas = List.filter (fun f -> is_asked (Property.Formula (Temporal.to_string f))) options.formulas }

(* {1 Counting} *)

(* [None] where vehicles may stay away from a [recruit] all the time, which no step shows, and where there is no time
   to count. *)
let count ~started (options : Search.options) program world start (property, (run : Search.run)) =
  let { Search.environment; limits; _ } = options in
  let tick = Limits.follow_up ~started limits in
  let shown () = Fault_count.of_run ~tick environment program world start (run.steps @ run.cycle) in
  let may_be_absent = program.Core.recruits && Faults.is_possible environment.faults.join in
  try
    match (property : Property.t) with
    | No_deadlock -> Some (Fault_count.of_deadlock ~tick environment program world start run.steps)
    | (Termination | Formula _) when may_be_absent -> None
    | Termination | Formula _ | No_error | Assertions | Vehicles | Allocation | No_halt | No_leftover | All_reached
    | Invariant _ | Apart _ -> Some (shown ())
  with Limits.Stop _ -> None

(* {1 Searching} *)

let without_faults ?start (options : Search.options) =
  let outside = Option.fold start ~none:Environment.initial ~some:snd in
  let environment, outside = Environment.without_faults (options.environment, outside) in
  let faults = { environment.faults with interrupt = options.environment.faults.interrupt } in
  ({ options with environment = { environment with faults } }, Option.map (fun (c, _) -> (c, outside)) start)

(* With faults to count, states are as many more: no more than [most] of them are looked at. *)
let with_some ~most ~environment (options : Search.options) =
  let reduction = if Reduction.by_symmetry options.reduction then Reduction.Vehicles else Whole in
  { options with environment; reduction; limits = { options.limits with max_states = Some most } }

(* Those in which, together, at most [n] faults come. One fault is of one kind, whose states are fewer than of all. *)
let environments n (environment : Environment.options) =
  let { Faults.fail; loss; join; interrupt } = environment.faults in
  let limited faults = { environment with faults; most_faults = Some n } in
  let none = { Faults.none with interrupt } in
  if n > 1 then [ limited environment.faults ]
  else
    List.map limited
      ((if Faults.is_possible fail then [ { none with fail } ] else [])
       @ (if Faults.is_possible loss then [ { none with loss } ] else [])
       @ if Faults.is_possible join then [ { none with join } ] else [])

(* A violation, and the run that shows it with its faults. *)
type shown = { property : Property.t; run : Search.run; faults : Search.faults option }

type progress = {
  shown : shown list;
  whole : bool;  (* no search was cut short *)
  most : int;  (* the states of the next search: where one was cut short, so may be the next ones, which have more *)
  bytes : int;
}

(* Where the number is not known, only runs without faults are looked for. *)
let least_known s = match s.faults with Some { number; _ } -> number | None -> 1

(* The searches of runs with at most [n] faults, and the number of states for the next ones. *)
let searches ?start ~started options program world ~properties ~most n =
  let asked = asking properties options in
  let search ?start options =
    Gc.full_major ();
    Search.run ?start ~phase:"looking for fewer faults" ~started options program world
  in
  if n = 0 then
    let options, start = without_faults ?start asked in
    ([ search ?start options ], most)
  else
    let add (found, most) environment =
      let (o : Search.outcome) = search ?start (with_some ~most ~environment asked) in
      (o :: found, if o.stopped = None then most else most / 2)
    in
    List.fold_left add ([], most) (environments n options.environment)

(* The shortest of the runs in [outcomes]; it is known to be if all of these are whole. *)
let shortest_of property (outcomes : Search.outcome list) =
  let runs = List.filter_map (fun o -> List.assoc_opt property (violated o)) outcomes in
  let shorter (best : Search.run) (run : Search.run) =
    if List.compare_lengths run.steps best.steps < 0 then run else best in
  let are_all = match outcomes with [ _ ] -> true | _ -> List.for_all (fun o -> o.Search.stopped = None) outcomes in
  match runs with
  | [] -> None
  | first :: others ->
    let run = List.fold_left shorter first others in
    Some { run with shortest = run.shortest && are_all }

let with_at_most ?start ~started (options : Search.options) program world ~count n p =
  let is_sought s = least_known s > n in
  match List.filter is_sought p.shown with
  | [] -> p
  | sought ->
    let properties = List.map (fun s -> s.property) sought in
    let outcomes, most = searches ?start ~started options program world ~properties ~most:p.most n in
    let is_open = function
      | property, Search.Inconclusive _ -> List.mem property properties
      | _, (Holds | Holds_if _ | Violated _ | By_design _ | Unreached _) -> false
    in
    let is_whole (o : Search.outcome) = o.stopped = None && not (List.exists is_open o.verdicts) in
    let whole = p.whole && List.for_all is_whole outcomes in
    let counted ~fewest number = { Search.number; fewest } in
    let better s =
      match shortest_of s.property outcomes with
      | Some run when n = 0 -> { s with run; faults = Some (counted ~fewest:true 0) }
      | Some run -> { s with run; faults = Option.map (counted ~fewest:p.whole) (count (s.property, run)) }
      | None ->
        let perhaps (f : Search.faults) = { f with fewest = f.fewest && whole } in
        { s with faults = Option.map perhaps s.faults }
    in
    let bytes = List.fold_left (fun most (o : Search.outcome) -> max most o.bytes) p.bytes outcomes in
    { shown = List.map (fun s -> if is_sought s then better s else s) p.shown; whole; most; bytes }

(* Numbers of faults are tried from 0 on; none is above those that were found. *)
let rec from n ~most search p = if n >= most then p else from (n + 1) ~most search (search n p)

let improved ?start ~started options program world (found : Search.outcome) =
  let beginning = Option.value start ~default:(Configuration.initial program, Environment.initial) in
  let count = count ~started options program world beginning in
  let first (property, run) =
    let counted number = { Search.number; fewest = true } in
    { property; run; faults = Option.map counted (count (property, run)) }
  in
  let shown = List.map first (violated found) in
  let p = { shown; whole = true; most = Search.most_again options; bytes = found.bytes } in
  let most = List.fold_left (fun most s -> max most (least_known s)) 0 p.shown in
  let p = from 0 ~most (with_at_most ?start ~started options program world ~count) p in
  let verdict (property, verdict) =
    match List.find_opt (fun s -> s.property = property) p.shown with
    | Some { run; faults; _ } -> (property, Search.Violated { run with faults })
    | None -> (property, verdict)
  in
  { found with verdicts = List.map verdict found.verdicts; bytes = p.bytes;
               seconds = options.limits.clock () -. started }

let run ?start (options : Search.options) program world =
  let started = options.limits.clock () in
  let found = Search.run ?start ~started options program world in
  let { Faults.fail; loss; join; interrupt = _ } = options.environment.faults in
  if List.exists Faults.is_possible [ fail; loss; join ] then improved ?start ~started options program world found
  else found
