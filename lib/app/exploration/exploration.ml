module Search = Dolphin_explore.Search
module Property = Dolphin_explore.Property
module Fewest_faults = Dolphin_explore.Fewest_faults
module Scenario_world = Dolphin_environment.Scenario_world

type settings = {
  answers : string list;
  faults : Dolphin_environment.Faults.t;
  reduction : Dolphin_explore.Reduction.t;
  compress : bool;
  spill : string option;
  walks : Search.walks option;
  bitstate : int option;
  workers : int;
  max_states : int option;
  max_depth : int option;
  max_memory : int option;
  timeout : float option;
  invariants : string list;
  formulas : string list;
  fairness : Search.fairness;
}

let plain =
  { answers = []; faults = Dolphin_environment.Faults.none; reduction = All; compress = false; spill = None;
    walks = None; bitstate = None; workers = 1; max_states = None; max_depth = None; max_memory = None; timeout = None;
    invariants = []; formulas = []; fairness = Weak }

let ( let* ) = Result.bind

(* {1 Exploring} *)

(* Each of [texts] read by [of_string], or the first that is wrong. *)
let read_all option of_string texts =
  let read text =
    Result.map_error
      (fun why -> Error.Bad_input (Printf.sprintf "%s '%s': %s" option text why))
      (of_string text)
  in
  Dolphin_results.Results.map read texts

let invariants program texts = read_all "--invariant" (Dolphin_explore.Condition.of_string program) texts

let formulas program texts = read_all "--ltl" (Dolphin_explore.Temporal.of_string program) texts

let check_violation s (program : Program_file.t) name =
  let core = program.program in
  let* invariants = invariants core s.invariants in
  let* formulas = formulas core s.formulas in
  let apart = Option.map (fun (fence : Dolphin_plans.Fences.fence) -> Property.Apart fence.text)
      (Dolphin_plans.Fences.least_distance core.fences) in
  let properties =
    Property.all
    @ List.map (fun i -> Property.Invariant (Dolphin_explore.Condition.to_string i)) invariants
    @ List.map (fun f -> Property.Formula (Dolphin_explore.Temporal.to_string f)) formulas
    @ Option.to_list apart
  in
  let names = List.map Property.name properties in
  if List.mem name names then Ok ()
  else
    Error (Error.Bad_input (Printf.sprintf "--violation '%s': there is no such property; the properties are %s"
                              (Dolphin_syntax.Character.printable name) (String.concat ", " names)))

let explore ?from ~interrupted ~progress s (program : Program_file.t) (fleet : Fleet_file.t) =
  let core = program.program in
  let* invariants = invariants core s.invariants in
  let* formulas = formulas core s.formulas in
  let environment = Scenario_world.environment ~answers:s.answers ~faults:s.faults core fleet.scenario in
  let options : Search.options =
    { environment;
      reduction = s.reduction; compress = s.compress; spill = s.spill; walks = s.walks; bitstate = s.bitstate;
      search_again = Search.default.search_again; workers = s.workers; fork_from = Search.default.fork_from;
      properties = Search.default.properties;
      spare_bits = Search.default.spare_bits;
      limits =
        Search_limits.make ?max_states:s.max_states ?max_depth:s.max_depth ?max_memory:s.max_memory ?timeout:s.timeout
          ~interrupted ~progress ();
      invariants; formulas; fairness = s.fairness }
  in
  match from with
  | None -> Ok (Fewest_faults.run options core (Scenario_world.world fleet.scenario))
  | Some present ->
    let environment, start = Present.start present environment core in
    Ok (Fewest_faults.run ~start { options with environment } core (Present.world present fleet.scenario))

(* {1 Verdicts} *)

let is_remark : Property.t -> bool = function
  | No_halt | No_leftover | All_reached -> true
  | No_deadlock | Termination | No_error | Assertions | Vehicles | Allocation | Invariant _ | Formula _ | Apart _ ->
    false

type verdict = Dolphin_checker.Verdict.t = Holds | Violated | Inconclusive

let verdict ~strict (o : Search.outcome) =
  let matters (property, _) = strict || not (is_remark property) in
  let verdicts = List.map snd (List.filter matters o.verdicts) in
  let is_violated = function
    | Search.Violated _ | Unreached _ -> true
    | Holds | Holds_if _ | By_design _ | Inconclusive _ -> false
  in
  let is_open = function
    | Search.Inconclusive _ -> true
    | Holds | Holds_if _ | By_design _ | Violated _ | Unreached _ -> false
  in
  if List.exists is_violated verdicts then Violated else if List.exists is_open verdicts then Inconclusive else Holds

let counterexamples (o : Search.outcome) =
  List.filter_map
    (fun (property, verdict) ->
       match (verdict : Search.verdict) with
       | Violated run -> Some (property, run)
       | Holds | Holds_if _ | By_design _ | Unreached _ | Inconclusive _ -> None)
    o.verdicts

let counterexample ~strict o =
  List.find_opt (fun (property, _) -> strict || not (is_remark property)) (counterexamples o)

let counterexample_of name o =
  let found = counterexamples o in
  match List.find_opt (fun (property, _) -> Property.name property = name) found with
  | Some counterexample -> Ok counterexample
  | None ->
    let others =
      match List.map (fun (property, _) -> Property.name property) found with
      | [] -> "no property has a run that violates it"
      | names -> "these have one: " ^ String.concat ", " names
    in
    Error (Error.Bad_input (Printf.sprintf "--violation '%s': no run that violates it is known; %s"
                              (Dolphin_syntax.Character.printable name) others))

(* {1 Witnesses} *)

let witness (property, (run : Search.run)) : Witness_file.run =
  { breaks = Property.name property; description = Property.name property ^ ": " ^ Property.question property;
    steps = run.steps; cycle = run.cycle }

let draw program fleet drawing found = Witness_file.draw program fleet drawing (witness found)
let write_witness program fleet path found = Witness_file.write program fleet path (witness found)
