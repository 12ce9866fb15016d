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

(* [options] that ask only for [properties], as far as there is a choice. *)
let asking properties (options : Search.options) =
  let is_asked property = List.mem property properties in
  { options with
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

(* The options and the start of runs with at most [n] faults. With faults to count, states are as many more: no more
   of them are looked at than for shortest runs. *)
let limited ?start (options : Search.options) = function
  | 0 ->
    let outside = Option.fold start ~none:Environment.initial ~some:snd in
    let environment, outside = Environment.without_faults (options.environment, outside) in
    let faults = { environment.faults with interrupt = options.environment.faults.interrupt } in
    ({ options with environment = { environment with faults } }, Option.map (fun (c, _) -> (c, outside)) start)
  | n ->
    let limits = { options.limits with max_states = Some (Search.most_again options) } in
    let reduction = if Reduction.by_symmetry options.reduction then Reduction.Vehicles else Whole in
    ({ options with environment = { options.environment with most_faults = Some n }; reduction; limits }, start)

(* A violation, and the run that shows it with its faults. *)
type shown = { property : Property.t; run : Search.run; faults : Search.faults option }

type progress = { shown : shown list; whole : bool;  (* no search was cut short *) bytes : int }

(* Where the number is not known, only runs without faults are looked for. *)
let least_known s = match s.faults with Some { number; _ } -> number | None -> 1

let with_at_most ?start ~started (options : Search.options) program world ~count n p =
  let is_sought s = least_known s > n in
  match List.filter is_sought p.shown with
  | [] -> p
  | sought ->
    Gc.full_major ();
    let properties = List.map (fun s -> s.property) sought in
    let limited, start' = limited ?start (asking properties options) n in
    let phase = "looking for fewer faults" in
    let found = Search.run ?start:start' ~phase ~sought:properties ~started limited program world in
    let is_open = function
      | property, Search.Inconclusive _ -> List.mem property properties
      | _, (Holds | Holds_if _ | Violated _ | By_design _ | Unreached _) -> false
    in
    let whole = p.whole && found.stopped = None && not (List.exists is_open found.verdicts) in
    let by_then = violated found in
    let counted ~fewest number = { Search.number; fewest } in
    let better s =
      match List.assoc_opt s.property by_then with
      | Some run when n = 0 -> { s with run; faults = Some (counted ~fewest:true 0) }
      | Some run -> { s with run; faults = Option.map (counted ~fewest:p.whole) (count (s.property, run)) }
      | None ->
        let perhaps (f : Search.faults) = { f with fewest = f.fewest && whole } in
        { s with faults = Option.map perhaps s.faults }
    in
    { shown = List.map (fun s -> if is_sought s then better s else s) p.shown; whole; bytes = max p.bytes found.bytes }

(* Numbers of faults are tried from 0 on; none is above those that were found. *)
let rec from n ~most search p = if n >= most then p else from (n + 1) ~most search (search n p)

let improved ?start ~started options program world (found : Search.outcome) =
  let beginning = Option.value start ~default:(Configuration.initial program, Environment.initial) in
  let count = count ~started options program world beginning in
  let first (property, run) =
    let counted number = { Search.number; fewest = true } in
    { property; run; faults = Option.map counted (count (property, run)) }
  in
  let p = { shown = List.map first (violated found); whole = true; bytes = found.bytes } in
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
