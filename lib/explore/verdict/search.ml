open Dolphin_plans
open Dolphin_semantics
open Dolphin_environment
open Dolphin_checker

type walks = { number : int; seed : int }
type fairness = Weak | Strong | No_fairness

type options = {
  environment : Environment.options;
  reduction : Reduction.t;
  compress : bool;
  spill : string option;
  walks : walks option;
  bitstate : int option;
  search_again : int;
  workers : int;
  fork_from : int;
  spare_bits : int option;
  limits : Limits.t;
  properties : Property.t list;
  invariants : Condition.t list;
  formulas : Temporal.t list;
  fairness : fairness;
}

let most_again options =
  Option.fold ~none:options.search_again ~some:(min options.search_again) options.limits.max_states

let default =
  {
    environment = Environment.default;
    reduction = Whole;
    compress = false;
    spill = None;
    walks = None;
    bitstate = None;
    search_again = 100_000;
    workers = 1;
    fork_from = 100_000;
    spare_bits = None;
    limits = Limits.none;
    properties = Property.all;
    invariants = [];
    formulas = [];
    fairness = Weak;
  }

type faults = { number : int; fewest : bool }

type run = {
  steps : Transition.t list;
  cycle : Transition.t list;
  shortest : bool;
  decided : int option;
  faults : faults option;
  helpful : Fair_cycles.help option;
}

type verdict =
  | Holds
  | Violated of run
  | Holds_if of World.assumption list list
  | By_design of {
      repeats : Core.site list;
      retries : Core.site list;
      left_by : string list;
      needs : World.assumption list list;
    }
  | Unreached of Coverage.piece list
  | Inconclusive of Limits.bound

type outcome = {
  states : int;
  transitions : int;
  expanded : int;
  depth : int;
  formula_states : int;
  beside_states : int;
  bytes : int;
  seconds : float;
  stopped : Limits.bound option;
  reduction : Reduction.t;
  vehicle_symmetry : bool;
  alike_values : bool;
  sample : Sample.summary option;
  bitstate : Bitstate.summary option;
  beside : Side_by_side.pair list;
  ending_faults : (Property.t * Fault.t list) list;
  only_in_worlds : Property.t list;
  fairness : fairness;
  verdicts : (Property.t * verdict) list;
}

(* {1 Searching} *)

(* What is searched, from which state on, and since when. *)
type subject = {
  program : Core.program;
  world : World.t;
  start : (Configuration.t * Environment.t) option;
  symmetry : Symmetry.t;
  started : float;
  phase : string option;  (* by default that of each search *)
}

let with_graph ?labelling ?phase x (options : options) f =
  let { environment; reduction; compress; spill; workers; fork_from; spare_bits; limits; invariants; _ } = options in
  let { program; world; start; symmetry; started; phase = given } = x in
  let phase = if given = None then phase else given in
  let observer = Option.map Labelling.observer labelling in
  let space =
    Space.create ~reduction ~symmetry ~asked:invariants ?observer ?spare_bits ?start environment program world in
  let monitor = Option.map Labelling.monitor labelling in
  let graph = State_graph.create ~compress ?spill ~workers ~fork_from ?monitor ?phase ~started limits space in
  Fun.protect ~finally:(fun () -> State_graph.close graph) (fun () -> f graph)

let broken_condition why : Limits.bound = Unsettled ("the condition cannot be evaluated: " ^ why)

let not_shown bound : Limits.bound =
  Unsettled (Format.asprintf "a violation was found, but %a before its run could be shown" Limits.pp_bound bound)

let showing run : verdict =
  match run () with run -> Violated run | exception Limits.Stop bound -> Inconclusive (not_shown bound)

let of_verdict run : _ Breadth_first.verdict -> verdict = function
  | Holds -> Holds
  | Violated found -> showing (fun () -> run found)
  | Inconclusive bound -> Inconclusive bound

(* A run that cannot be shown, because a bound is met or the disk fails, is not reported. *)
let bounded ~stopped find =
  match find () with
  | found -> found
  | exception Limits.Stop bound -> stopped bound
  | exception Out_of_memory -> stopped Limits.No_memory
  | exception States.Disk_failed why -> stopped (Unsettled why)

let told verdict = bounded ~stopped:(fun bound -> Inconclusive bound) verdict

(* {1 Verdicts} *)

let run_of ?decided ?(shortest = false) ~steps ~cycle () =
  { steps; cycle; shortest; decided; faults = None; helpful = None }

let termination_of_script ~tick graph ~shortest =
  let run ({ stem; around } : Breadth_first.lasso) =
    let steps, cycle = Rebuilt_run.around ~tick graph ~stem around in
    let is_as_short = List.compare_lengths stem steps > 0 && List.compare_lengths around cycle > 0 in
    run_of ~shortest:(shortest && is_as_short) ~steps ~cycle ()
  in
  of_verdict run (State_graph.termination graph ~exact:(State_graph.is_exact graph))

let is_symmetric graph = Space.exchanges (State_graph.system graph)

(* Assumptions with which it would hold; they are looked for as long as shortest runs are. If steps or vehicles were
   left out, all states may show more. *)
let helpful x (options : options) graph =
  let by_order = Reduction.by_order options.reduction in
  let assumed = options.environment.recurring in
  let search ~all graph =
    if State_graph.stopped graph <> None then Fair_cycles.No_help
    else Fair_cycles.helpful x.program graph ~all ~assumed ~strong:(options.fairness = Strong)
  in
  let most = most_again options in
  let again reduction =
    let limits = { options.limits with max_states = Some most } in
    let options = { options with reduction; invariants = []; limits } in
    with_graph ~phase:"looking for assumptions" { x with symmetry = Symmetry.none } options (fun graph ->
        State_graph.run graph;
        search ~all:(not (Reduction.by_order reduction)) graph)
  in
  let rec first : (unit -> Fair_cycles.advice) list -> _ = function
    | [] -> None
    | search :: others -> (
        match search () with Help help -> Some help | No_help -> None | In_more_states -> first others)
  in
  match
    if State_graph.count graph > most then None
    else
      first
        ([ (fun () -> search ~all:(not by_order) graph) ]
         @ (if by_order && is_symmetric graph then [ (fun () -> again Partial_order) ] else [])
         @ [ (fun () -> again Whole) ])
  with
  | found -> found
  | exception (Limits.Stop _ | Environment.Unclear _ | Out_of_memory) -> None

(* The places where a task may run without end. *)
let rec termination_of_rounds x (options : options) graph =
  let all = not (Reduction.by_order options.reduction) in
  let violated ({ stem; around } : Fair_cycles.lasso) ~helpful =
    let rebuilt () = Rebuilt_run.around ~tick:(State_graph.follow_up graph) graph ~stem around in
    showing (fun () ->
        let steps, cycle = rebuilt () in
        { (run_of ~steps ~cycle ()) with helpful })
  in
  match State_graph.stopped graph with
  | Some bound -> Inconclusive bound
  | None -> (
      let { Fair_cycles.verdict; needs } =
        Fair_cycles.judge x.program graph ~all ~assumed:options.environment.recurring
          ~strong:(options.fairness = Strong)
      in
      match verdict with
      | Ends when needs <> [] -> Holds_if needs
      | Ends -> Holds
      | Goes_on lasso -> violated lasso ~helpful:(helpful x options graph)
      | Spins lasso -> violated lasso ~helpful:None
      | By_design { repeats; retries; left_by } -> By_design { repeats; retries; left_by; needs }
      | Unsure -> in_more_states x options graph)

(* Partial order reduction may omit the fair steps, and symmetry exchange the vehicles whose sensors are looked at. *)
and in_more_states x options graph =
  let reduction =
    if is_symmetric graph && Reduction.by_order options.reduction then Reduction.Partial_order else Reduction.Whole in
  let options = { options with reduction; invariants = [] } in
  with_graph ~phase:"looking for cycles" { x with symmetry = Symmetry.none } options (fun graph ->
      State_graph.run graph;
      termination_of_rounds x options graph)

(* A cycle that a search without all states met is one only of runs that may go round it. *)
let of_some_states x (options : options) graph found =
  match found with
  | Violated { cycle; _ }
    when State_graph.stopped graph = None
      && not (Looks.may_repeat x.program ~assumed:options.environment.recurring cycle) ->
    termination_of_rounds x options graph
  | Violated { cycle; _ } when not (Looks.may_repeat x.program ~assumed:options.environment.recurring cycle) ->
    Inconclusive
      (Unsettled "the readings on the cycle that was met contradict each other or an assumption of the fleet")
  | found -> found

let termination ~tick x (options : options) graph ~shortest =
  let is_kept = options.walks = None && options.bitstate = None in
  let by_script () = termination_of_script ~tick graph ~shortest in
  if Space.goes_round (State_graph.system graph) then termination_of_rounds x options graph
  else if not is_kept then of_some_states x options graph (by_script ())
  else
    match State_graph.termination graph ~exact:(State_graph.is_exact graph) with
    | Holds | Inconclusive _ -> by_script ()
    | Violated { stem; around } ->
      let has_assumptions = options.environment.recurring <> [] || options.fairness = Strong in
      if has_assumptions || not (Fair_cycles.may_go_round x.program graph { stem; around }) then
        termination_of_rounds x options graph
      else
        match by_script () with
        | Violated run -> Violated { run with helpful = helpful x options graph }
        | (Holds | Holds_if _ | By_design _ | Unreached _ | Inconclusive _) as verdict -> verdict

let run_through ~tick graph ~shortest states =
  run_of ~shortest ~steps:(Rebuilt_run.through ~tick graph states) ~cycle:[] ()

let invariant ~tick graph ~shortest i : verdict =
  match Invariant.broken i, Invariant.trouble i, State_graph.stopped graph with
  | Some state, _, _ -> showing (fun () -> run_through ~tick graph ~shortest (State_graph.path graph state))
  | None, Some why, _ -> Inconclusive (broken_condition why)
  | None, None, Some bound -> Inconclusive bound
  | None, None, None -> Holds

let unreached graph program : verdict =
  match State_graph.stopped graph, Coverage.unreached (Space.coverage (State_graph.system graph)) program with
  | Some bound, _ -> Inconclusive bound
  | None, [] -> Holds
  | None, pieces -> Unreached pieces

let verdicts x (options : options) graph invariants =
  let shortest = options.walks = None && options.bitstate = None && not (Reduction.by_order options.reduction) in
  let tick = State_graph.follow_up graph in
  let run = run_through ~tick graph ~shortest in
  let verdict = function
    | Property.No_deadlock -> of_verdict run (State_graph.no_deadlock graph)
    | (No_error | Assertions | Vehicles | Allocation | No_halt | No_leftover) as property ->
      of_verdict run (State_graph.never graph property)
    | Termination -> termination ~tick x options graph ~shortest
    | All_reached -> unreached graph x.program
    | Invariant _ | Formula _ | Apart _ -> invalid_arg "Search.verdicts"
  in
  let given i =
    let verdict () = invariant ~tick graph ~shortest i in
    (Property.Invariant (Condition.to_string (Invariant.condition i)), told verdict)
  in
  (* Code that a run has behind it is reached by none of those from there on. *)
  let is_asked property = property <> Property.All_reached || x.start = None in
  let asked = List.filter is_asked options.properties in
  List.map (fun property -> (property, told (fun () -> verdict property))) asked @ List.map given invariants

(* The faults that end runs, of each place in the text the first that was met; of no larger graphs. *)
let most_listed = 100_000

let faults_of_runs (options : options) graph verdicts =
  let note found i =
    match State_graph.broken_by graph i with
    | Some ((No_error | Assertions | Vehicles | Allocation) as property) -> (
        match fst (State_graph.state graph i) with
        | { control = Ended (Failed fault); _ } ->
          let before = Option.value (List.assoc_opt property found) ~default:[] in
          if List.exists (fun (f : Fault.t) -> f.site = fault.site) before then found
          else (property, before @ [ fault ]) :: List.remove_assoc property found
        | _ -> found)
    | Some _ | None -> found
  in
  let is_sought = function
    | (Property.No_error | Assertions | Vehicles | Allocation), Violated _ -> true
    | _, (Holds | Holds_if _ | By_design _ | Violated _ | Unreached _ | Inconclusive _) -> false
  in
  let is_kept = options.walks = None && options.bitstate = None && State_graph.count graph <= most_listed in
  if is_kept && List.exists is_sought verdicts then List.fold_left note [] (State_graph.all graph) else []

(* The first state that shows that [property] is violated. *)
let shown graph = function
  | Property.No_deadlock -> State_graph.deadlock graph
  | property -> State_graph.broken graph property

(* Of [n] components each has steps, and each of these leads to a state with as many: so a large state counts as
   several. *)
let effort_of_state n = max 1 (n * n / 64)

(* A violation found by a reduced search is looked up among the first of all states, for a shortest run. *)
let with_shortest_runs x (options : options) verdicts =
  let is_sought = function
    | (Property.Termination | Invariant _ | Formula _ | Apart _), _ -> false
    | _, (Holds | Holds_if _ | By_design _ | Unreached _ | Inconclusive _) -> false
    | _, Violated { shortest; _ } -> not shortest
  in
  match List.map fst (List.filter is_sought verdicts) with
  | [] -> verdicts
  | sought ->
    let most = most_again options in
    let limits = { options.limits with max_states = Some most } in
    let x = { x with symmetry = Symmetry.without_tasks x.symmetry } in
    with_graph x { options with reduction = Whole; invariants = []; limits } (fun graph ->
        let effort = ref 0 in
        let look i = effort := !effort + effort_of_state (State_graph.breadth graph i) in
        let enough () = !effort >= most || List.for_all (fun property -> shown graph property <> None) sought in
        State_graph.run ~look ~enough graph;
        let tick = State_graph.follow_up graph in
        let through i = run_through ~tick graph ~shortest:true (State_graph.path graph i) in
        let shortest i = told (fun () -> Violated (through i)) in
        let shorter (property, verdict) =
          match Option.map shortest (if List.mem property sought then shown graph property else None) with
          | Some (Violated _ as shorter) -> (property, shorter)
          | Some (Holds | Holds_if _ | By_design _ | Unreached _ | Inconclusive _) | None -> (property, verdict)
        in
        List.map shorter verdicts)

(* {1 Runs that no world has} *)

let contradictory = "the readings on the runs that were found contradict each other"

(* Runs whose looks agree, in place of those that violate a property and whose looks do not; they are looked for as
   long as shortest runs are. Also the properties that hold as there are none. *)
let with_runs_of_worlds x (options : options) verdicts =
  let { program; world; start; started; _ } = x in
  let start = Option.value start ~default:(Configuration.initial program, Environment.initial) in
  let is_sought : Property.t -> bool = function
    | No_deadlock | No_error | Assertions | Vehicles | Allocation | No_halt | No_leftover | Invariant _ -> true
    | Termination | All_reached | Formula _ | Apart _ -> false
  in
  let is_of_no_world = function
    | property, Violated { steps; cycle = []; _ } ->
      is_sought property && not (Moment_search.agrees program world (fst start) steps)
    | _, (Violated _ | Holds | Holds_if _ | By_design _ | Unreached _ | Inconclusive _) -> false
  in
  let searches = (program.reads_sensors || program.reads_now) && most_again options > 0 in
  match if searches then List.map fst (List.filter is_of_no_world verdicts) else [] with
  | [] -> (verdicts, [])
  | sought ->
    let tick = Limits.follow_up ~started options.limits in
    let limit = most_again options in
    let search () =
      Moment_search.search ~tick ~limit ~conditions:options.invariants options.environment program world start sought in
    let found = bounded ~stopped:(fun _ -> { Moment_search.runs = []; whole = false }) search in
    let of_world (property, verdict) =
      match List.assoc_opt property found.runs with
      | Some steps -> (property, Violated (run_of ~shortest:true ~steps ~cycle:[] ()))
      | None when not (List.mem property sought) -> (property, verdict)
      | None -> (property, if found.whole then Holds else Inconclusive (Unsettled contradictory))
    in
    let verdicts = List.map of_world verdicts in
    let has_none property = not (List.mem_assoc property found.runs) in
    (verdicts, if found.whole then List.filter has_none sought else [])

(* {1 Formulas} *)

(* The states once more in the product with the formula: the answer, the number of states, and their memory. *)
let product x (options : options) f answer =
  let labelling = Labelling.create x.program x.world f in
  let search graph =
    State_graph.run graph;
    let found = answer graph labelling in
    (found, State_graph.count graph, State_graph.memory graph)
  in
  let options = { options with reduction = Whole; invariants = Temporal.conditions f } in
  with_graph ~labelling ~phase:"exploring for formulas" x options search

let of_product x (options : options) graph labelling (found : _ Breadth_first.verdict) =
  let run violation =
    let tick = State_graph.follow_up graph in
    let found = Counterexample.of_violation ~tick options.environment x.program x.world graph labelling violation in
    run_of ?decided:found.decided ~shortest:(found.decided <> None) ~steps:found.steps ~cycle:found.cycle ()
  in
  let fair = options.fairness <> No_fairness and strong = options.fairness = Strong in
  let assumed = options.environment.recurring in
  let is_kept stem cycle =
    let around = List.nth stem (List.length stem - 1) :: List.map fst cycle in
    not (fair && (strong || assumed <> [] || Space.goes_round (State_graph.system graph)))
    && Fair_cycles.may_go_round x.program graph { stem; around }
  in
  match found with
  | Violated (Breadth_first.Around { stem; cycle }) when not (is_kept stem cycle) -> (
      match Fair_cycles.violation x.program graph (Labelling.monitor labelling) ~strong ~fair ~assumed with
      | Some violation, _ -> showing (fun () -> run violation)
      | None, [] -> Holds
      | None, needs -> Holds_if needs)
  | Holds | Violated _ | Inconclusive _ -> of_verdict run found

(* [None]: it has to be found in all states. Around a cycle of the quotient a name need not be the same vehicle's each
   time, so its looks at sensors or the date do not show whether a run may go round it. *)
let rec up_to_symmetry x (options : options) f =
  let looks = x.program.reads_sensors || x.program.reads_now || options.environment.recurring <> [] in
  let answer graph labelling =
    let judge () =
      match State_graph.formula graph with
      | Violated (Around _) when looks -> None
      | (Holds | Violated _ | Inconclusive _) as found -> Some (of_product x options graph labelling found)
    in
    bounded ~stopped:(fun bound -> Some (Inconclusive bound)) judge
  in
  if Vehicle_orbits.is_none x.symmetry.vehicles then (None, 0, 0)
  else
    match product x options f answer with
    | found -> found
    | exception Symmetry.Broken symmetry -> up_to_symmetry { x with symmetry } options f

let in_all_states x options f =
  let answer graph labelling = told (fun () -> of_product x options graph labelling (State_graph.formula graph)) in
  product { x with symmetry = Symmetry.none } options f answer

let formula x (options : options) f =
  let symmetry =
    if Reduction.by_symmetry options.reduction then
      let asked = Temporal.conditions f and named = Temporal.names f in
      Symmetry.without_tasks (Symmetry.find options.environment x.program ~asked ~named x.world)
    else Symmetry.none
  in
  let search () =
    match up_to_symmetry { x with symmetry } options f with
    | Some verdict, states, bytes -> (verdict, states, bytes)
    | None, states, bytes ->
      Gc.full_major ();
      let verdict, more, bytes' = in_all_states x options f in
      (verdict, states + more, max bytes bytes')
  in
  match search () with
  | found -> found
  | exception Valuation.Broken why -> (Inconclusive (broken_condition why), 0, 0)
  | exception Environment.Unclear fault -> (Inconclusive (Space.unsettled x.program fault), 0, 0)

(* No other states are needed any more: there must be room for those of the formulas. *)
let with_formulas x (options : options) found =
  let add found f =
    Gc.full_major ();
    let verdict, states, bytes = formula x options f in
    { found with
      verdicts = found.verdicts @ [ (Property.Formula (Temporal.to_string f), verdict) ];
      formula_states = found.formula_states + states;
      bytes = max found.bytes bytes;
      seconds = options.limits.clock () -. x.started }
  in
  List.fold_left add found options.formulas

(* {1 Plans side by side} *)

(* The observations of a search. *)
type sight = {
  beside : Side_by_side.t;
  near : verdict option;  (* a run to the first state in which plans are near *)
  stopped : Limits.bound option;
  count : int;
  memory : int;
}

let see_state beside graph i =
  let c, _ = State_graph.state graph i in
  match c.Configuration.control with
  | Executing _ -> Side_by_side.see beside c.shared.allocation
  | Script _ | Waiting _ | Ended _ -> ()

(* The states of [options], as far as they are needed, until [enough]. *)
let rec seen x (options : options) ~enough =
  let beside = Side_by_side.create x.program.fences in
  let search graph =
    let first = ref None in
    let look i =
      see_state beside graph i;
      if !first = None && Side_by_side.first_near beside then first := Some i
    in
    State_graph.run ~look ~enough:(fun () -> enough beside) graph;
    let tick = State_graph.follow_up graph in
    let through i = run_through ~tick graph ~shortest:true (State_graph.path graph i) in
    let run i = told (fun () -> showing (fun () -> through i)) in
    { beside; near = Option.map run !first; stopped = State_graph.stopped graph; count = State_graph.count graph;
      memory = State_graph.memory graph }
  in
  match with_graph ~phase:"looking for plans side by side" x options search with
  | sight -> sight
  | exception Symmetry.Broken symmetry -> seen { x with symmetry } options ~enough

(* Which pairs there might be is known from fewer states: each plan that may run starts in one of them. *)
let candidates x (options : options) =
  if options.reduction = Whole || x.program.recruits then None
  else
    let all = seen x { options with reduction = Partial_order } ~enough:(fun _ -> false) in
    if all.stopped = None then Some (Side_by_side.candidates all.beside, all) else None

let beside x (options : options) =
  let options = { options with invariants = []; walks = None; bitstate = None } in
  let vehicles =
    if Reduction.by_symmetry options.reduction then Symmetry.find options.environment x.program ~asked:[] x.world
    else Symmetry.none
  in
  let x = { x with symmetry = Symmetry.without_tasks vehicles } in
  let whole enough =
    let all = seen x { options with reduction = Whole } ~enough in
    (Side_by_side.pairs all.beside, all)
  in
  match candidates x options with
  | Some (0, all) -> ([], all)
  | Some (candidates, _) -> whole (Side_by_side.seen_all ~candidates)
  | None -> whole (fun _ -> false)

let of_unknown (pairs : Side_by_side.pair list) =
  let is_unknown (p : Side_by_side.pair) = p.nearness = Unknown in
  let why { Side_by_side.one = _, p; other = _, q; _ } : Limits.bound =
    Unsettled (Printf.sprintf "the distance between %s and %s, which may run side by side, is unknown"
                 (Side_by_side.name p) (Side_by_side.name q)) in
  Option.map why (List.find_opt is_unknown pairs)

let apart x (options : options) found =
  match Fences.least_distance x.program.fences with
  | None -> found
  | Some fence ->
    Gc.full_major ();
    let pairs, all = beside x options in
    let verdict =
      match all.near, all.stopped, of_unknown pairs with
      | Some near, _, _ -> near
      | None, Some bound, _ | None, None, Some bound -> Inconclusive bound
      | None, None, None -> Holds
    in
    { found with
      verdicts = found.verdicts @ [ (Property.Apart fence.text, verdict) ];
      beside = pairs;
      beside_states = all.count;
      bytes = max found.bytes all.memory;
      seconds = options.limits.clock () -. x.started }

(* {1 Outcomes} *)

let without_formulas x (options : options) =
  with_graph x options @@ fun graph ->
  let invariants = List.map (Invariant.create x.program x.world) options.invariants in
  let check i = List.iter (fun invariant -> Invariant.check invariant graph i) invariants in
  let look = if invariants = [] then None else Some check in
  let told () = Marshal.to_string (List.map Invariant.told invariants) [] in
  let hear ~first text =
    List.iter2 (fun invariant -> Invariant.hear invariant ~first) invariants (Marshal.from_string text 0) in
  let watcher = Option.map (fun see -> { Watcher.see; told; hear }) look in
  (match options.walks, options.bitstate with
   | Some { number; seed }, _ -> State_graph.run_walks ?look graph ~walks:number ~seed
   | None, Some bytes -> State_graph.run_bitstate ?look graph ~bytes
   | None, None -> State_graph.run ?watcher graph);
  let verdicts = with_shortest_runs x options (verdicts x options graph invariants) in
  let verdicts, only_in_worlds = with_runs_of_worlds x options verdicts in
  let space = State_graph.system graph and bitstate = State_graph.bitstate graph in
  let states =
    match bitstate with Some (s : Bitstate.summary) -> s.states | None -> State_graph.count graph in
  let reduction =
    if Space.used_task_symmetry space then options.reduction else Reduction.without_symmetry options.reduction
  in
  {
    states;
    transitions = State_graph.transitions graph;
    expanded = State_graph.expanded graph;
    depth = State_graph.depth graph;
    formula_states = 0;
    beside_states = 0;
    bytes = State_graph.memory graph;
    seconds = options.limits.clock () -. x.started;
    stopped = State_graph.stopped graph;
    reduction;
    vehicle_symmetry = Space.used_vehicle_symmetry space;
    alike_values = false;
    sample = State_graph.sample graph;
    bitstate;
    beside = [];
    ending_faults = faults_of_runs options graph verdicts;
    only_in_worlds;
    fairness = options.fairness;
    verdicts;
  }

(* Restarted with less symmetry when a state breaks it. *)
let rec explore x (options : options) =
  match without_formulas x options with
  | found -> found
  | exception Symmetry.Broken symmetry -> explore { x with symmetry } options

(* Unobservable parts are not remembered, unless the graph is requested as it is defined. *)
let relevant program (options : options) =
  match options.reduction with
  | Whole | Vehicles -> options
  | Partial_order | Symmetry | All ->
    { options with environment = Later_picks.forgetting program options.environment }

(* The task of an interruption depends on the whole state at that time. *)
let reducible program (options : options) =
  if Environment.may_leave options.environment program then { options with reduction = Whole } else options

let judged ?start ?phase ~started (options : options) program world =
  let symmetry =
    if Reduction.by_symmetry options.reduction then
      Symmetry.find options.environment program ~asked:options.invariants world
    else Symmetry.none
  in
  (* Invariants cannot be judged by the representatives of a task's states, nor are runs to them the shortest. *)
  let options, symmetry =
    if options.invariants = [] && options.reduction <> Vehicles then (options, symmetry)
    else ({ options with reduction = Whole }, Symmetry.without_tasks symmetry)
  in
  explore { program; world; start; symmetry; started; phase } options

let without_symmetry (options : options) program =
  let options = relevant program (reducible program options) in
  let reduction = if options.invariants = [] then Reduction.without_symmetry options.reduction else Whole in
  { options with reduction }

let space { environment; reduction; _ } program world = Space.create ~reduction environment program world

(* {1 Values that are alike} *)

(* The runs of [program], which go in step with those of [image]. *)
let in_step ~started options program world ~image (found : outcome) =
  let tick = Limits.follow_up ?stopped:found.stopped ~started options.limits in
  let ends_alike (t : Transition.t) (real : Transition.t) =
    Property.broken_by_end program t.rules t.next = Property.broken_by_end program real.rules real.next
  in
  let of_verdict (property, verdict) =
    match verdict with
    | Holds | Holds_if _ | By_design _ | Unreached _ | Inconclusive _ -> Some (property, verdict)
    | Violated ({ steps; cycle; _ } as run) ->
      let real ({ steps; cycle } : Lockstep.run) =
        (property,
         Violated { run with steps; cycle; shortest = run.shortest && List.compare_lengths steps run.steps = 0 })
      in
      let follow () = Lockstep.follow ~tick options.environment world program ~image ~ends_alike { steps; cycle } in
      match follow () with
      | found -> Option.map real found
      | exception Limits.Stop bound -> Some (property, Inconclusive (not_shown bound))
  in
  let verdicts = List.map of_verdict found.verdicts in
  if List.exists Option.is_none verdicts then None
  else Some { found with verdicts = List.filter_map Fun.id verdicts; alike_values = true }

let judged_with_alike_values ?start ?phase ~started (options : options) program world =
  let unified =
    if Reduction.by_symmetry options.reduction && options.invariants = [] then
      Alike_values.unify options.environment program
    else None
  in
  match unified with
  | None -> judged ?start ?phase ~started options program world
  | Some image -> (
      match in_step ~started options program world ~image (judged ?phase ~started options image world) with
      | Some found -> found
      | None -> judged ?phase ~started options program world)

(* In the middle of a run, vehicles and values that the whole program treats alike have parts of their own. *)
let unlike (options : options) = { options with reduction = Reduction.without_symmetry options.reduction }

let run ?start ?phase ?started (options : options) program world =
  let options = reducible program options in
  let options = if start = None then relevant program options else unlike options in
  let started = match started with Some started -> started | None -> options.limits.clock () in
  let found = judged_with_alike_values ?start ?phase ~started options program world in
  let x = { program; world; start; symmetry = Symmetry.none; started; phase } in
  apart x options (with_formulas x options found)

let side_by_side (options : options) program world =
  let options = relevant program (reducible program options) in
  let x = { program; world; start = None; symmetry = Symmetry.none; started = options.limits.clock (); phase = None } in
  let pairs, all = beside x options in
  (pairs, all.stopped)

(* {1 Text} *)

let reductions o =
  Reduction.names o.reduction
  @ (if o.vehicle_symmetry then [ "symmetry of vehicles" ] else [])
  @ if o.alike_values then [ "symmetry of values" ] else []

let pp_needs ppf needs =
  let one ppf readings = Format.fprintf ppf "%a recurs" Looks.pp_readings readings in
  Format.fprintf ppf "if %a" Fmt.(list ~sep:(any " and ") one) needs

let needs o =
  let of_verdict = function
    | _, (Holds_if needs | By_design { needs; _ }) -> needs
    | _, (Holds | Violated _ | Unreached _ | Inconclusive _) -> []
  in
  let compare = List.compare World.compare_assumption in
  List.sort_uniq compare (List.concat_map of_verdict o.verdicts)

let faults_text { number; _ } =
  match number with 0 -> "without a fault" | 1 -> "with 1 fault" | n -> Printf.sprintf "with %d faults" n

let strongly = "with --fairness strong"

let pp_verdict ?(fairness = Weak) (program : Core.program) ppf (property, verdict) =
  let print format = Format.fprintf ppf format in
  let with_help found =
    let help { Fair_cycles.recurring; strong } =
      print "; holds %s" (if strong then strongly else "");
      if strong && recurring <> [] then print ", ";
      if recurring <> [] then pp_needs ppf recurring
    in
    Option.iter help found.helpful
  in
  let by_fairness = if fairness = Strong && Property.is_of_fair_runs property then " " ^ strongly else "" in
  let steps n = if n = 1 then "1 step" else Printf.sprintf "%d steps" n in
  let with_faults { faults; _ } =
    let text f = Printf.sprintf ", %s%s" (faults_text f) (if f.fewest then "" else " (perhaps fewer)") in
    Option.fold faults ~none:"" ~some:text
  in
  print "%a: " Property.pp property;
  match verdict with
  | Holds -> print "holds%s" by_fairness
  | Holds_if needs -> print "holds%s%s %a" by_fairness (if by_fairness = "" then "" else ",") pp_needs needs
  | By_design { repeats; retries; left_by; needs } ->
    let at ppf (word, site) =
      match Fault.location program (Fault.make site "") with
      | Some at -> Format.fprintf ppf "%s at %a" word Dolphin_syntax.Location.pp at
      | None -> Format.fprintf ppf "a %s" word
    in
    let all = List.map (fun site -> ("repeat", site)) repeats @ List.map (fun site -> ("retry", site)) retries in
    let left_by = if left_by = [] then "nothing that may happen here" else String.concat ", " left_by in
    print "by design not: %a; ended by %s" (Fmt.list ~sep:(Fmt.any ", ") at) all left_by;
    if needs <> [] then print "; only this, %a" pp_needs needs
  | Violated ({ steps = run; cycle = []; _ } as found) when property = Assertions -> (
      print "violated after %s%s: " (steps (List.length run)) (with_faults found);
      match (List.nth run (List.length run - 1)).next.control with
      | Ended (Failed fault) ->
        Option.iter (print "%a: " Dolphin_syntax.Location.pp) (Fault.location program fault);
        print "%s" fault.message
      | Ended (Completed | Halted _ | Interrupted) | Script _ | Waiting _ | Executing _ ->
        print "%s" (Property.question property))
  | Violated ({ decided = Some n; _ } as found) ->
    print "violated after %s%s: %s" (steps n) (with_faults found) (Property.question property)
  | Violated ({ steps = run; cycle = []; _ } as found) ->
    print "violated after %s%s: %s" (steps (List.length run)) (with_faults found) (Property.question property)
  | Violated ({ steps = run; cycle; _ } as found) ->
    print "violated%s: after %s, %s that can repeat without end" (with_faults found) (steps (List.length run))
      (steps (List.length cycle));
    with_help found
  | Unreached pieces ->
    let piece ppf (p : Coverage.piece) =
      match Fault.location program (Fault.make p.site "") with
      | Some at -> Format.fprintf ppf "%s at %a" p.what Dolphin_syntax.Location.pp at
      | None -> Format.pp_print_string ppf p.what
    in
    print "violated: no run reaches %a" (Fmt.list ~sep:(Fmt.any ", ") piece) pieces
  | Inconclusive bound -> print "inconclusive, %a" Limits.pp_bound bound
