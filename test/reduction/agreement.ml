open Dolphin_semantics
open Dolphin_environment
open Dolphin_checker
open Dolphin_explore

type t = { whole : int; reduced : int; broken : Property.t list }

let ( let* ) = Result.bind

(* {1 Runs} *)

(* The possible states of a run after these transitions: each is offered, with the same label and the same result. *)
let follow options program world states steps =
  let step states (t : Transition.t) =
    let is_it ((t' : Transition.t), _) =
      t'.rules = t.rules
      && Format.asprintf "%a" Label.pp t'.label = Format.asprintf "%a" Label.pp t.label
      && Configuration.equal t'.next t.next
    in
    let offered (c, e) = List.of_seq (Seq.filter is_it (Environment.choices options program world e c)) in
    List.concat_map (fun state -> List.map (fun ((t : Transition.t), e) -> (t.next, e)) (offered state)) states
  in
  List.fold_left step states steps

let same (c, e) (c', e') = Configuration.equal c c' && Environment.compare e e' = 0

(* Lost vehicles are not remembered where it makes no difference: a run repeats without end, although it may lose
   another vehicle the first time. *)
let shows options program world property (run : Search.run) =
  let options = Later_picks.forgetting program options in
  let start = [ (Configuration.initial program, Environment.initial) ] in
  let there = follow options program world start run.steps in
  let stuck (c, e) =
    (Environment.is_stuck options program e (Environment.choices options program world e c))
    && match c.Configuration.control with Ended _ -> false | Script _ | Waiting _ | Executing _ -> true
  in
  match (property : Property.t) with
  | No_deadlock -> List.exists stuck there
  | Termination ->
    let back = follow options program world there run.cycle in
    run.cycle <> [] && List.exists (fun s -> List.exists (same s) back) there
  | No_error | Assertions | Vehicles | Allocation | No_halt | No_leftover -> (
      match List.rev run.steps with
      | [] -> false
      | last :: _ -> there <> [] && Property.broken_by_end program last.rules last.next = Some property)
  | All_reached | Invariant _ | Formula _ | Apart _ -> false

(* {1 Outcomes}

   More than any property asks: the results of executed tasks, in all runs. How many failures there were is left out:
   a reduced run may do with fewer. And a deadlock beside branches of an [allOf] may be shown after those only. In
   programs that recruit, which make tasks in tasks, deadlocks are compared as texts: the numbers of timers and
   recruits depend on the other ones in use at that time. *)

type outcome =
  | Of_script of Configuration.t
  | Stuck of Configuration.t
  | Stuck_like of string
  | Broken of Configuration.ending

module Outcomes = Set.Make (struct
    type t = outcome

    let compare a b =
      match a, b with
      | Of_script c, Of_script c' | Stuck c, Stuck c' -> Configuration.compare c c'
      | Stuck_like text, Stuck_like text' -> String.compare text text'
      | Broken e, Broken e' -> Stdlib.compare e e'
      | (Of_script _ | Stuck _ | Stuck_like _ | Broken _), _ ->
        let rank = function Of_script _ -> 0 | Stuck _ -> 1 | Stuck_like _ -> 2 | Broken _ -> 3 in
        Int.compare (rank a) (rank b)
  end)

let rec is_in_all_of : Residual.t -> bool = function
  | All_of _ -> true
  | Parallel bs -> List.exists is_in_all_of (Branches.to_list bs)
  | r -> ( match Residual.opened r with Some (_, body) -> is_in_all_of body | None -> false)

let stuck_in (program : Core.program) c =
  if program.recruits then Stuck_like (Format.asprintf "%a" (Configuration.pp program) c) else Stuck c

let outcome program (c : Configuration.t) ~stuck outcomes =
  match c.control with
  | Ended ((Halted _ | Failed _ | Interrupted) as ending) -> Outcomes.add (Broken ending) outcomes
  | Ended Completed | Script _ | Waiting _ -> Outcomes.add (Of_script c) outcomes
  | Executing (_, r) -> if stuck && not (is_in_all_of r) then Outcomes.add (stuck_in program c) outcomes else outcomes

let all_outcomes (g : Reference.t) =
  let found = ref Outcomes.empty in
  let is_stuck i = Environment.is_stuck g.options g.program g.states.(i).outside (List.to_seq g.edges.(i)) in
  let state i (s : Reference.state) = found := outcome g.program s.configuration ~stuck:(is_stuck i) !found in
  Array.iteri state g.states;
  !found

let reduced_outcomes environment program world =
  let environment = Later_picks.forgetting program environment in
  let graph = State_graph.create Limits.none (Space.create ~reduction:Partial_order environment program world) in
  let rec from i found =
    if i = State_graph.count graph then State_graph.flush graph;
    if i = State_graph.count graph then found
    else begin
      let interruptions = if environment.Environment.faults.interrupt then 1 else 0 in
      let n = State_graph.expand graph i in
      let c, e = State_graph.state graph i in
      let stuck =
        let simple = environment.inputs = [] && not (Environment.may_leave environment program) in
        if simple && not program.Core.recruits then n <= interruptions
        else Environment.is_stuck environment program e (Environment.choices environment program world e c)
      in
      from (i + 1) (outcome program c ~stuck found)
    end
  in
  from 0 Outcomes.empty

let same_outcomes program environment world graph =
  let missing = Outcomes.diff (all_outcomes graph) (reduced_outcomes environment program world) in
  match Outcomes.choose_opt missing with
  | None -> Ok ()
  | Some (Of_script c) -> Error (Format.asprintf "the script never comes to %a" (Configuration.pp program) c)
  | Some (Stuck c) -> Error (Format.asprintf "no run gets stuck in %a" (Configuration.pp program) c)
  | Some (Stuck_like text) -> Error (Printf.sprintf "no run gets stuck in %s" text)
  | Some (Broken (Halted m)) -> Error ("no run halts with " ^ m)
  | Some (Broken (Failed fault)) -> Error ("no run fails with " ^ fault.message)
  | Some (Broken (Completed | Interrupted)) -> Error "an end is missing"

(* {1 Verdicts} *)

(* The search of all states gives the verdict on termination where rounds may go on without end. *)
let terminates_alike (whole : Search.verdict) (verdict : Search.verdict) =
  match whole, verdict with
  | Holds, Holds | Violated _, Violated _ -> true
  | By_design { repeats; _ }, By_design { repeats = repeats'; _ } -> repeats = repeats'
  | (Holds | Holds_if _ | Violated _ | By_design _ | Unreached _ | Inconclusive _), _ -> false

let agrees ?termination options program world reference unreached (property, verdict) =
  let wrong what = Error (Printf.sprintf "%s: %s" (Property.name property) what) in
  match (verdict : Search.verdict), termination with
  | Violated run, Some whole when property = Property.Termination && terminates_alike whole verdict ->
    if shows options program world property run then Ok () else wrong "this is no such run"
  | _, Some whole when property = Property.Termination ->
    if terminates_alike whole verdict then Ok () else wrong "another verdict"
  | _, _ ->
    match (verdict : Search.verdict), List.mem_assoc property reference with
    | Holds, false when property <> All_reached || unreached = [] -> Ok ()
    | Unreached pieces, _ when pieces = unreached -> Ok ()
    | Violated run, true -> if shows options program world property run then Ok () else wrong "this is no such run"
    | (Holds | Holds_if _ | By_design _ | Violated _), _ -> wrong "another verdict"
    | Unreached _, _ -> wrong "other pieces are reached"
    | Inconclusive _, _ -> wrong "inconclusive"

(* Partial order visits each state in which a step may end the run. *)
let same_places (reduction : Reduction.t) (whole : Search.outcome) (reduced : Search.outcome) =
  let places (o : Search.outcome) =
    let of_property (property, faults) = List.map (fun (f : Fault.t) -> (property, f.site)) faults in
    List.sort compare (List.concat_map of_property o.ending_faults)
  in
  reduction <> Partial_order || places whole = places reduced

let check_graph ~reductions environment program world graph =
  let reference = Reference.broken graph in
  let search reduction = Search.run { Search.default with environment; reduction; search_again = 0 } program world in
  let whole = search Whole in
  let unreached =
    match List.assoc Property.All_reached whole.verdicts with
    | Unreached pieces -> pieces
    | Holds | Holds_if _ | By_design _ | Violated _ | Inconclusive _ -> []
  in
  let termination =
    if Reference.goes_round graph then List.assoc_opt Property.Termination whole.verdicts else None
  in
  let is_as_short (property, verdict) =
    match (verdict : Search.verdict), List.assoc_opt property reference with
    | Violated { shortest = true; steps; cycle = [] }, Some length -> List.length steps = length
    | _, _ -> true
  in
  let compare found reduction =
    let* _ = found in
    let named what = Error (String.concat ", " (Reduction.names reduction) ^ ": " ^ what) in
    let reduced = search reduction in
    let each found verdict =
      let* () = found in
      if is_as_short verdict then agrees ?termination environment program world reference unreached verdict
      else Error "there is a shorter run"
    in
    match List.fold_left each (Ok ()) reduced.verdicts with
    | Error what -> named what
    | Ok () when not (same_places reduction whole reduced) -> named "faults at other places"
    | Ok () -> if reduced.states > whole.states then named "more states than there are" else Ok reduced.states
  in
  let* reduced = List.fold_left compare (Ok 0) reductions in
  Ok { whole = whole.states; reduced; broken = List.map fst reference }

let explored ?limit environment program world =
  match Reference.explore ?limit environment program world with
  | graph -> graph
  | exception Environment.Unclear _ -> None

(* Where the search of all states meets outcomes that cannot be listed, so does each reduced one. *)
let unsettled ~limit reductions environment program world =
  let limits = { Limits.none with max_states = limit } in
  let is_unsettled reduction =
    let options = { Search.default with environment; reduction; limits; search_again = 0 } in
    match (Search.run options program world).stopped with
    | Some (Unsettled _ | States) -> true
    | Some _ | None -> false
  in
  match List.find_opt (fun reduction -> not (is_unsettled reduction)) reductions with
  | None -> Ok None
  | Some reduction -> Error (String.concat ", " (Reduction.names reduction) ^ ": what is unclear is not met")

let check ?limit ?(reductions = [ Reduction.Partial_order; Symmetry; All ]) environment program world =
  match Reference.explore ?limit environment program world with
  | exception Environment.Unclear _ -> unsettled ~limit reductions environment program world
  | None -> Ok None
  | Some graph ->
    let* found = check_graph ~reductions environment program world graph in
    let* () = same_outcomes program environment world graph in
    Ok (Some found)

(* {1 Up to the names of vehicles} *)

(* Texts of ends may name vehicles, and only the emptiness of N matters at the end. *)
let without_text (c : Configuration.t) =
  let ended ending =
    let none = Tuples.empty Tuple_space.no_key in
    let tuples = if Tuples.is_empty c.shared.tuples then none else Tuples.post "left" Core.Null none in
    { Configuration.control = Ended ending; shared = { c.shared with tuples } }
  in
  match c.control with
  | Ended (Halted _) -> ended (Halted "")
  | Ended (Failed fault) -> ended (Failed { fault with message = "" })
  | Ended ((Completed | Interrupted) as ending) -> ended ending
  | Script _ | Waiting _ | Executing _ -> c

module Script = Map.Make (struct
    type t = Configuration.t * Environment.t

    let compare (c, e) (c', e') =
      match Configuration.compare c c' with 0 -> Environment.compare e e' | order -> order
  end)

(* Configurations, each with the least number of vehicles that were late before it, and no memory of which. *)
let with_fewest_late canonical states =
  let add found (c, e) =
    let memory = Environment.memory e in
    let number = List.length memory.late in
    let others = max 0 (memory.spent - number) in
    let c, e =
      if number = 0 then (c, e) else canonical c (Environment.of_memory { memory with late = []; spent = others }) in
    let fewest before = Some (Option.fold ~none:number ~some:(min number) before) in
    Script.update (without_text c, e) fewest found
  in
  List.fold_left add Script.empty states

let is_of_script (c : Configuration.t) =
  match c.control with Script _ | Waiting _ | Ended _ -> true | Executing _ -> false

let rec explored_up_to symmetry environment program world =
  let graph = State_graph.create Limits.none (Space.create ~symmetry environment program world) in
  match State_graph.run graph with
  | () -> graph
  | exception Symmetry.Broken symmetry -> explored_up_to symmetry environment program world

let same_script program environment world (graph : Reference.t) =
  let tell what c = Error (Format.asprintf "%s %a" what (Configuration.pp program) c) in
  let symmetry = Symmetry.without_tasks (Symmetry.find environment program ~asked:[] world) in
  let reduced = explored_up_to symmetry environment program world in
  let space = State_graph.system reduced in
  let canonical = Space.canonical space in
  let states = List.map (fun (s : Reference.state) -> (s.configuration, s.outside)) (Array.to_list graph.states) in
  let of_script = List.filter (fun (c, _) -> is_of_script c) in
  let expected = with_fewest_late canonical (List.map (fun (c, e) -> canonical c e) (of_script states)) in
  let reached = List.init (State_graph.count reduced) (State_graph.state reduced) in
  let found = with_fewest_late canonical (of_script reached) in
  let differ _ fewest fewest' = if fewest = fewest' then None else Some (fewest, fewest') in
  match Script.min_binding_opt (Script.merge differ expected found) with
  | Some ((c, _), (Some _, None)) -> tell "the script never comes to" c
  | Some ((c, _), (None, _)) -> tell "the script cannot come to" c
  | Some ((c, _), (Some _, Some _)) -> tell "another number of vehicles were late before" c
  | None -> Ok (Space.used_vehicle_symmetry space)

(* Whether a condition is the same in all that is looked at as in all that there is. *)
let same_invariant program environment world condition =
  let search reduction =
    let options = { Search.default with environment; reduction; invariants = [ condition ]; search_again = 0 } in
    snd (List.find (fun (p, _) -> match p with Property.Invariant _ -> true | _ -> false)
        (Search.run options program world).verdicts)
  in
  let wrong what = Error (Printf.sprintf "invariant %s: %s" (Condition.to_string condition) what) in
  let is_broken (c, _) = Condition.eval program world condition c = Fails in
  match search Whole, search All with
  | Holds, Holds | Inconclusive _, Inconclusive _ -> Ok ()
  | Violated run, Violated run' ->
    let start = [ (Configuration.initial program, Environment.initial) ] in
    if List.compare_lengths run.steps run'.steps <> 0 then wrong "another length"
    else if List.exists is_broken (follow environment program world start run'.steps) then Ok ()
    else wrong "this is no such run"
  | (Holds | Holds_if _ | By_design _ | Violated _ | Inconclusive _ | Unreached _), _ -> wrong "another verdict"

let check_peers ?limit ?(invariants = []) environment program world =
  match explored ?limit environment program world with
  | None -> Ok None
  | Some graph ->
    let* found = check_graph ~reductions:[ All; Symmetry ] environment program world graph in
    let* used = same_script program environment world graph in
    let check found condition =
      let* () = found in
      same_invariant program environment world condition
    in
    let* () = List.fold_left check (Ok ()) invariants in
    Ok (Some (found, used))
