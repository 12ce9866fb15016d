open Dolphin_semantics
open Dolphin_tlc
module Run = Dolphin_tla.Tlc_questions
module Search = Dolphin_explore.Search
module Property = Dolphin_explore.Property

type t = Not_translated of string | Judged of { tlc : string; explorer : string; agree : bool }

(* A property of the specification may be several of the explorer's. *)
let properties =
  [ ("NoDeadlock", [ Property.No_deadlock ]); ("Termination", [ Termination ]); ("NoError", [ No_error ]);
    ("Assertions", [ Assertions ]); ("EnoughVehicles", [ Vehicles; Allocation ]); ("NoHalt", [ No_halt ]);
    ("NoLeftover", [ No_leftover ]) ]

let all_hold = "all hold"

(* TLC is not asked of runs that stay in the rounds of one task. *)
let is_asked_of_tlc property (run : Search.run) =
  let executes (t : Transition.t) =
    match t.next.control with Executing _ -> true | Script _ | Waiting _ | Ended _ -> false
  in
  List.exists (fun (_, ps) -> List.mem property ps) properties
  && not (property = Property.Termination && run.cycle <> [] && List.for_all executes run.cycle)

let violated_here (c : Case.t) =
  (* The runs that are found in the states, as TLC finds them, also those of no world. *)
  let o = Search.run { Search.default with environment = c.environment; search_again = 0 } c.program c.world in
  let violated (property, (verdict : Search.verdict)) =
    match verdict with
    | Violated run when is_asked_of_tlc property run -> Some (Property.name property)
    | Violated _ | Holds | Holds_if _ | By_design _ | Unreached _ | Inconclusive _ -> None
  in
  List.filter_map violated o.verdicts

(* TLC counts each cycle; the explorer leaves out those on which looks at sensors contradict each other in no time. *)
let has_cycle (c : Case.t) =
  match Dolphin_explore.Reference.explore c.environment c.program c.world with
  | Some g -> List.mem_assoc Property.Termination (Dolphin_explore.Reference.broken g)
  | None -> false

let judge (c : Case.t) (o : Outcome.t) =
  let here = violated_here c in
  let judged tlc agree =
    Ok (Judged { tlc; explorer = (if here = [] then all_hold else String.concat ", " here); agree })
  in
  let named name =
    match List.assoc_opt name properties with
    | Some all ->
      let names = List.map Property.name all in
      judged (String.concat " or " names) (List.exists (fun name -> List.mem name here) names)
    | None -> Error (name ^ " does not hold")
  in
  match o.verdict with
  | Holds -> judged all_hold (here = [])
  | Violated { violation = Invariant name | Property name; _ } -> named name
  | Violated { violation = Temporal; _ } when World.is_open c.world && here = [] ->
    judged (Property.name Termination) (has_cycle c)
  | Violated { violation = Temporal; _ } -> named "Termination"
  | Violated { violation = Deadlock | Unnamed; _ } -> Error "TLC looked for deadlocks by itself, though told not to"
  | Unfinished -> Error "TLC did not come to its end"
  | Gave_up why -> Error why
  | Failed lines -> Error (String.concat "\n" lines)

let verdicts ?(specification = []) installation (c : Case.t) =
  match Translated.model c with
  | Error why -> Ok (Not_translated why)
  | Ok model ->
    let text (f : Dolphin_tla.Model.file) = Option.value (List.assoc_opt f.name specification) ~default:f.text in
    let files = List.map (fun (f : Dolphin_tla.Model.file) -> (f.name, text f)) (Run.files ~strict:true model) in
    judge c (Tlc_run.outcome installation ~main:Run.main ~configuration:Run.check files)
