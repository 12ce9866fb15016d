open Dolphin_plans
open Dolphin_semantics
module Limits = Dolphin_checker.Limits
module Scenario = Dolphin_scenario.Scenario
module Search = Dolphin_checker.Breadth_first.Make (Timed_system)

type date = Timed_system.date = At of int | Unbounded
type window = { earliest : int; latest : date }

type run = {
  steps : Transition.t list;
  dates : int list;
  turns : Batteries.turn list;
  cycle : Transition.t list;
  chain : Schedule.link list;
}

type reduction = Timed_system.reduction = Nothing | Inert_ends | Inert_ends_and_canonical_states

type task = Timed_system.task = { name : string; vehicle : Core.vehicle; site : Core.site }

type battery = { vehicle : Core.vehicle; least : float; lowest : (float * run) option }

module Side_by_side = Dolphin_explore.Side_by_side

type apart = { fence : string; pairs : Side_by_side.pair list; cut_short : Limits.bound option }

type outcome = {
  endings : (Timed_system.ending * window) list;
  tasks : (task * (Timed_system.moment * window) list) list;
  last : run option;
  first : run option;
  endless : (run * [ `Cycle | `In_no_time | `Stuck ]) option;
  unknown : Clocked.pending list;
  deadlines : (Core.site * (window * run) option) list;
  late : run option;
  failing : run option;
  batteries : battery list;
  apart : apart option;
  stopped : Limits.bound option;
  reduction : Timed_system.reduction;
  states : int;
  depth : int;
  seconds : float;
  bytes : int;
}

type slacks = { known : (task * Slack.t) list; cut_short : Limits.bound option }

(* {1 Runs} *)

(* Of steps from [start] with their dates, if these are known. *)
let with_dates options start steps ~chain dates =
  let found = Clocked.transitions options start steps in
  let date i = match dates with Some dates -> [ dates.(i) ] | None -> [] in
  let known = List.mapi (fun i t -> Option.map (fun t -> (t, date i)) t) found in
  let known = List.filter_map Fun.id known in
  { steps = List.map fst known; dates = List.concat_map snd known; cycle = []; chain;
    turns = Option.fold dates ~none:[] ~some:(fun dates -> Batteries.turns options start steps (Array.to_list dates)) }

let run_of goal options system steps =
  let start = Timed_system.start system in
  let schedule = Schedule.make goal (Timed_system.successors system) start steps in
  with_dates options start steps (Option.map (fun (s : Schedule.t) -> s.dates) schedule)
    ~chain:(Option.fold schedule ~none:[] ~some:(fun (s : Schedule.t) -> s.chain))

let run_along goal options system moves =
  match Unfold.run system goal moves with
  | Some steps -> run_of goal options system steps
  | None -> raise Timed_system.Broken

let run_to goal options system n = run_along goal options system (Timed_system.path system n)

let rec without n xs = match xs with _ :: rest when n > 0 -> without (n - 1) rest | xs -> xs

let run_around options system (c : Timed_system.cycle) =
  let steps n = Option.get (Unfold.run system Latest (Timed_system.path system n)) in
  let stem = steps c.from and whole = steps c.last in
  let around = without (List.length stem) whole @ [ c.back ] in
  let undated from steps = with_dates options from steps ~chain:[] None in
  let start = Timed_system.start system in
  let from = List.fold_left (fun _ (s : Clocked.step) -> s.next) start stem in
  { (undated start stem) with cycle = (undated from around).steps }

let endless options system =
  match Timed_system.cycle system, Timed_system.stuck system with
  | Some c, _ -> Some (run_around options system c, if c.in_no_time then `In_no_time else `Cycle)
  | None, Some n -> Some ({ (run_to Latest options system n) with chain = [] }, `Stuck)
  | None, None -> None

(* The end that [is_better] than all others. *)
let best is_better system =
  let better found (_, (date, n)) =
    match found with Some (known, _) when not (is_better date known) -> found | Some _ | None -> Some (date, n)
  in
  List.fold_left better None (Timed_system.endings system)

let is_later a b =
  match a, b with Unbounded, At _ -> true | At m, At n -> m > n | (At _ | Unbounded), Unbounded -> false

let is_sooner a b = is_later b a

(* {1 Both searches} *)

let window earliest latest =
  match earliest with At earliest -> Some { earliest; latest } | Unbounded -> None

(* Entries with one name in both lists. *)
let windows early late =
  let both (name, latest) =
    let earliest = List.assoc_opt name early in
    Option.map (fun w -> (name, w)) (Option.bind earliest (fun earliest -> window earliest latest))
  in
  List.filter_map both late

(* Each [within], as both searches found it. *)
let deadlines options early late =
  let early = Timed_system.deadlines early in
  let both (site, missed) =
    let with_earliest (latest, moves) =
      match Option.join (List.assoc_opt site early) with
      | Some (earliest, _) ->
        Option.map (fun window -> (window, run_along Timed_system.Latest options late moves)) (window earliest latest)
      | None -> None
    in
    (site, Option.bind missed with_earliest)
  in
  List.map both (Timed_system.deadlines late)

let search ?working ?start ~started limits successors goal phase =
  let search = Search.create ~phase ~started limits (Timed_system.create ?working ?start goal successors) in
  Search.run search;
  search

(* {1 Batteries} *)

(* Sums of shares may be off in their last digits. *)
let slightly = 1e-9

let is_empty share = share < slightly

(* In a run whose dates are known. *)
let left v run = Batteries.left v run.turns ~until:(List.fold_left max 0 run.dates)

(* The findings about a battery: a bound, and the ways of a search that may have it. *)
type bounded = { bound : float; of_ways : (Timed_system.t * Timed_system.edge list) list }

(* The same, from a search of its own that observes [v]: with charging, and with the looks at the battery. *)
let observed ~reduction ~started limits options (v : Scenario.vehicle) =
  let course = Course.create options v.id in
  let search = search ~started limits (Successors.create ~course reduction options) Latest "batteries" in
  let system = Search.system search in
  let found (l : Levels.t) =
    { bound = l.least; of_ways = List.map (fun way -> (system, way)) (Option.to_list l.way) } in
  if Search.stopped search = None then Option.map found (Levels.of_vehicle system v) else None

(* The run with least in its battery among [known] and those along the ways: with the latest dates, the earliest, and
   those in which it is under way for long. It is looked for until one has no more than the bound. *)
let lowest options (v : Scenario.vehicle) known { bound; of_ways } =
  let along (system, way) goal () =
    match run_along goal options system (Timed_system.along system way) with
    | run -> Some run
    | exception (Timed_system.Broken | Dates.Contradiction) -> None
  in
  let stretched (system, way) goal () =
    match Unfold.run system goal (Timed_system.along system way) with
    | None -> None
    | Some steps -> (
        let start = Timed_system.start system in
        let spans = Batteries.spans options v start steps in
        match Schedule.stretched (Timed_system.successors system) start steps spans with
        | Some dates -> Some (with_dates options start steps ~chain:[] (Some dates))
        | None | (exception Dates.Contradiction) -> None)
    | exception (Timed_system.Broken | Dates.Contradiction) -> None
  in
  let of_way way =
    [ along way Timed_system.Latest; along way Earliest; stretched way Latest; stretched way Earliest ] in
  let rec lowest found = function
    | [] -> found
    | _ when Option.fold found ~none:false ~some:(fun (left, _) -> left <= bound +. slightly) -> found
    | run :: runs -> (
        match run (), found with
        | (None | Some { dates = []; _ }), _ -> lowest found runs
        | Some run, Some (known, _) when known <= left v run -> lowest found runs
        | Some run, (Some _ | None) -> lowest (Some (left v run, run)) runs)
  in
  lowest known (List.concat_map of_way of_ways)

(* For programs that look at sensors no run is shown: their readings do not follow from the time. Neither does it
   follow whether a vehicle rests at a charger. *)
let battery options ~observed ~last ~is_known ~charges (v : Scenario.vehicle) first =
  let is_shown = is_known && (not options.Clocked.program.reads_sensors) && v.chargers = [] in
  let improved known found = if is_shown then lowest options v known found else None in
  let of_last (run : run) = if run.dates = [] then None else Some (left v run, run) in
  let known = if is_shown then Option.bind last of_last else None in
  let known = Option.fold first ~none:known ~some:(improved known) in
  let is_exact { bound; _ } = Option.fold known ~none:false ~some:(fun (left, _) -> left <= bound +. slightly) in
  let with_ { bound; _ } lowest = Some { vehicle = v.id; least = bound; lowest } in
  let may_be_closer = v.charge > 0. || charges || options.program.reads_sensors in
  match first with
  | Some first when is_exact first || not may_be_closer -> with_ first known
  | first -> (
      match observed v, first with
      | None, None -> None
      | Some { bound; _ }, None when is_empty bound -> None
      | None, Some first -> with_ first known
      | Some found, first ->
        let bound = Float.max found.bound (Option.fold first ~none:0. ~some:(fun first -> first.bound)) in
        let found = { found with bound } in
        with_ found (improved known found))

let batteries options system ~observed ~tasks ~last ~is_known vehicles =
  let of_bound (v, bound, way) = (v, { bound; of_ways = List.map (fun way -> (system, way)) (Option.to_list way) }) in
  let bounds = if is_known then List.map of_bound (Batteries.least system vehicles) else [] in
  let of_vehicle (v : Scenario.vehicle) =
    match List.filter (fun ((task : task), _) -> task.vehicle = v.id) tasks with
    | [] -> None
    | tasks ->
      let charges = List.exists (fun ((task : task), _) -> options.Clocked.durations.charges task.name <> None) tasks in
      battery options ~observed ~last ~is_known ~charges v (List.assq_opt v bounds)
  in
  List.filter_map of_vehicle vehicles

(* A search that observes a battery has more states than one that does not. The number of times that are worth
   computing. *)
let most_observed = 10

let find ?start ~(reduction : reduction) ~started ?deadline ~vehicles limits options =
  let successors = Successors.create reduction options in
  let late = search ~working:(vehicles <> []) ?start ~started limits successors Latest "latest dates" in
  let early = search ?start ~started limits successors Earliest "earliest dates" in
  let late_system = Search.system late and early_system = Search.system early in
  let dates system = List.map (fun (e, (date, _)) -> (e, date)) (Timed_system.endings system) in
  let tasks =
    let early = Timed_system.tasks early_system in
    let both (task, moments) =
      (task, windows (Option.value (List.assoc_opt task early) ~default:[]) moments)
    in
    List.map both (Timed_system.tasks late_system)
  in
  let last = best is_later late_system in
  let is_late date = match deadline with Some deadline -> is_later date (At deadline) | None -> false in
  let run_at goal system = Option.map (fun (_, n) -> run_to goal options system n) in
  let last_run = run_at Latest late_system last in
  let endless = endless options late_system in
  let stopped = match Search.stopped late with Some bound -> Some bound | None -> Search.stopped early in
  let is_known = endless = None && stopped = None in
  let observed =
    let most = most_observed * (100 + Search.count late) in
    let max_states = Some (Option.fold limits.max_states ~none:most ~some:(min most)) in
    observed ~reduction ~started { limits with max_states } options
  in
  let batteries tasks last = batteries options late_system ~observed ~tasks ~last ~is_known in
  { endings = windows (dates early_system) (dates late_system); tasks;
    last = last_run; first = run_at Earliest early_system (best is_sooner early_system);
    endless;
    unknown = Timed_system.unknown late_system;
    deadlines = deadlines options early_system late_system;
    late = (match last with Some (date, _) when is_late date -> last_run | Some _ | None -> None);
    failing = run_at Latest late_system (List.assoc_opt Timed_system.Failed (Timed_system.endings late_system));
    batteries = (if stopped = None then batteries tasks last_run vehicles else []);
    apart = None;
    stopped;
    reduction;
    states = Search.count late + Search.count early;
    depth = max (Search.depth late) (Search.depth early);
    seconds = limits.Limits.clock () -. started;
    bytes = max (Search.memory late) (Search.memory early) }

(* With less left out where more was unsound. *)
let rec attempt find (reduction : reduction) =
  try find reduction
  with Timed_system.Broken ->
    attempt find (match reduction with Inert_ends_and_canonical_states -> Inert_ends | _ -> Nothing)

(* {1 Plans side by side} *)

(* Pairs that no run has at one time, whatever the times, need not be looked for. *)
let untimed limits (options : Clocked.options) =
  Dolphin_explore.Search.(side_by_side { default with environment = options.environment; reduction = All; limits })
    options.program options.world

(* Ends that are inert leave A too, and states that are alike have other plans: so all is followed. *)
let pairs ?start ~started limits (options : Clocked.options) ~candidates =
  let beside = Side_by_side.create options.program.fences in
  let system = Timed_system.create ?start Latest (Successors.create Nothing options) in
  let search = Search.create ~phase:"looking for plans side by side" ~started limits system in
  let seen = ref 0 in
  let enough () =
    while !seen < Timed_system.count system do
      Side_by_side.see beside (Timed_system.state system !seen).configuration.shared.allocation;
      incr seen
    done;
    Option.fold candidates ~none:false ~some:(fun candidates -> Side_by_side.seen_all ~candidates beside)
  in
  Search.run ~enough search;
  ignore (enough ());
  (Side_by_side.pairs beside, Search.stopped search)

let apart ?start ~started limits (options : Clocked.options) =
  let found (fence : Fences.fence) =
    let pairs, cut_short =
      match untimed limits options with
      | _ when start <> None || Links.count options.durations.links > 0 ->
        pairs ?start ~started limits options ~candidates:None
      | [], stopped -> ([], stopped)
      | candidates, None -> pairs ~started limits options ~candidates:(Some (List.length candidates))
      | _, Some _ -> pairs ~started limits options ~candidates:None
    in
    { fence = fence.text; pairs; cut_short }
  in
  Option.map found (Fences.least_distance options.program.fences)

(* {1 From the middle of a run} *)

let dates_after ms o =
  let date = function At n -> At (n + ms) | Unbounded -> Unbounded in
  let window w = { earliest = w.earliest + ms; latest = date w.latest } in
  let turn (t : Batteries.turn) = { t with at = t.at + ms } in
  let run r = { r with dates = List.map (( + ) ms) r.dates; turns = List.map turn r.turns } in
  let windows of_named = List.map (fun (name, w) -> (name, window w)) of_named in
  let missed (site, found) = (site, Option.map (fun (w, r) -> (window w, run r)) found) in
  { o with
    endings = windows o.endings; tasks = List.map (fun (task, moments) -> (task, windows moments)) o.tasks;
    last = Option.map run o.last; first = Option.map run o.first; late = Option.map run o.late;
    failing = Option.map run o.failing; endless = Option.map (fun (r, why) -> (run r, why)) o.endless;
    deadlines = List.map missed o.deadlines }

type start = { state : Clocked.state; date : int }

(* A run that never ends, or fails, is shown without faults where there is such a run. Its links are those of the runs
   with faults: else it may be none of them. *)
let plainly search (options : Clocked.options) found =
  let { Dolphin_environment.Faults.fail; loss; join; interrupt } = options.environment.faults in
  let has_faults = List.exists Dolphin_environment.Faults.is_possible [ fail; loss; join ] in
  if not (has_faults && (found.endless <> None || found.failing <> None)) then found
  else
    let faults = { Dolphin_environment.Faults.none with interrupt } in
    let links = Durations.links_with options.environment.faults options.durations in
    let durations = { options.durations with links } in
    let plain = search { options with environment = { options.environment with faults }; durations } in
    let either first second = if first <> None then first else second in
    { found with
      endless = either plain.endless found.endless; failing = either plain.failing found.failing;
      bytes = max plain.bytes found.bytes; seconds = plain.seconds }

(* What is reduced is alike, or inert, from the beginning. *)
let run ?start ?(reduction = Inert_ends_and_canonical_states) ?deadline ?(vehicles = []) limits options =
  let started = limits.Limits.clock () in
  let state = Option.map (fun s -> s.state) start and past = Option.fold start ~none:0 ~some:(fun s -> s.date) in
  let reduction, vehicles = if start = None then (reduction, vehicles) else (Nothing, []) in
  let deadline = Option.map (fun date -> date - past) deadline in
  let search ~vehicles options =
    attempt (fun reduction -> find ?start:state ~reduction ~started ?deadline ~vehicles limits options) reduction in
  let found = search ~vehicles options in
  let found = if start = None then plainly (search ~vehicles:[]) options found else found in
  let found =
    match apart ?start:state ~started limits options with
    | None -> found
    | Some _ as apart -> { found with apart; seconds = limits.clock () -. started }
  in
  dates_after past found

let slack_searches = "slack"

let latest_end ~started limits options =
  let find reduction =
    let search = search ~started limits (Successors.create reduction options) Latest slack_searches in
    let system = Search.system search in
    match Search.stopped search, Timed_system.cycle system, Timed_system.stuck system, best is_later system with
    | Some _, _, _, _ -> None
    | None, None, None, Some (date, _) -> Some date
    | None, _, _, _ -> Some Unbounded
  in
  attempt find Inert_ends_and_canonical_states

let latest o =
  let later found (_, w) = match found with Some d when not (is_later w.latest d) -> found | _ -> Some w.latest in
  List.fold_left later None o.endings

let slacks ?(workers = 1) limits options o =
  let started = limits.Limits.clock () and tasks = Array.of_list (List.map fst o.tasks) in
  match o.endless, o.stopped, latest o with
  | None, None, Some (At n) ->
    let slack limits i = Slack.of_task ~latest:(latest_end ~started limits) options n tasks.(i) in
    let measures : Limits.measures = { states = 0; expanded = 0; depth = 0; used = o.bytes; growth = 0 } in
    let count = Array.length tasks in
    let found, cut_short = Share_out.all ~workers ~started limits measures ~phase:slack_searches ~count slack in
    { known = List.filter_map (fun (i, slack) -> Option.map (fun slack -> (tasks.(i), slack)) slack) found; cut_short }
  | Some _, _, _ | None, Some _, _ | None, None, (Some Unbounded | None) -> { known = []; cut_short = None }

(* Unknown for events without a latest date. *)
let is_late ?deadline o = match deadline, latest o with Some n, Some (At m) -> m > n | _ -> false

let runs_empty b = match b.lowest with Some (share, _) -> is_empty share | None -> false
let may_run_empty b = is_empty b.least

type verdict = Dolphin_checker.Verdict.t = Holds | Violated | Inconclusive

let judge_apart a =
  let is_near (p : Side_by_side.pair) = match p.nearness with Near _ -> true | Unknown -> false in
  if List.exists is_near a.pairs then Violated
  else if a.pairs <> [] || a.cut_short <> None then Inconclusive
  else Holds

let apart_is verdict o = Option.map judge_apart o.apart = Some verdict

type shortfall = Never_ends | Fails | Late | Misses | Empty | Too_near | Unknown

let shortfall ?deadline o =
  let latest = latest o in
  let is_unknown =
    o.stopped <> None || latest = None || (deadline <> None && latest = Some Unbounded)
    || List.exists may_run_empty o.batteries || apart_is Inconclusive o in
  if o.endless <> None then Some Never_ends
  else if List.mem_assoc Timed_system.Failed o.endings then Some Fails
  else if is_late ?deadline o then Some Late
  else if List.exists (fun (_, missed) -> missed <> None) o.deadlines then Some Misses
  else if List.exists runs_empty o.batteries then Some Empty
  else if apart_is Violated o then Some Too_near
  else if is_unknown then Some Unknown
  else None

let in_time ?deadline o =
  if o.endless <> None || is_late ?deadline o then Violated
  else if o.stopped <> None || latest o = Some Unbounded || latest o = None then Inconclusive
  else Holds

let verdict ?deadline o =
  match in_time ?deadline o with
  | Violated -> Violated
  | Holds | Inconclusive when List.exists runs_empty o.batteries || apart_is Violated o -> Violated
  | Holds when List.exists may_run_empty o.batteries || apart_is Inconclusive o -> Inconclusive
  | (Holds | Inconclusive) as verdict -> verdict
