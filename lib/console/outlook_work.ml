open Dolphin_app
open Dolphin_json
open Exchange
module Faults = Dolphin_environment.Faults
module Property = Dolphin_explore.Property
module Search = Dolphin_explore.Search
module Timed_analysis = Dolphin_time.Timed_analysis

let hash program = (Program_file.header program).Dolphin_trace.Header.hash

let order ~program ~journal : json =
  `Assoc
    [ ("journal", `String journal); ("program", `String program.Program_file.path);
      ("hash", `String (hash program)) ]

(* {1 The questions} *)

(* Of each question. All three, with the reading of the journal, are over before a worker is. *)
let seconds = 4.
let most_memory = 512 * 1024 * 1024

let never () = false
let unseen _ = ()

let in_time =
  { Time_analysis.answers = []; faults = Faults.none; deadline = None; workers = 1; max_states = None;
    max_depth = None; max_memory = Some most_memory; timeout = Some seconds }

let over from program fleet = Time_analysis.run ~from ~interrupted:never ~progress:unseen in_time program fleet

let violations from faults program fleet =
  let settings = { Exploration.plain with faults; max_memory = Some most_memory; timeout = Some seconds } in
  let counts (property, (verdict : Search.verdict)) =
    match verdict with
    | Violated _ | Unreached _ -> not (Exploration.is_remark property)
    | Holds | Holds_if _ | By_design _ | Inconclusive _ -> false
  in
  let of_outcome (o : Search.outcome) = (List.map fst (List.filter counts o.verdicts), o.stopped = None) in
  Result.map of_outcome (Exploration.explore ~from ~interrupted:never ~progress:unseen settings program fleet)

(* {1 The reply} *)

let seconds_of ms = Canonical.number (float_of_int ms /. 1000.)

(* Tasks whose durations are not known have no windows. *)
let json_of_running (r : Time_analysis.running) : json option =
  match r.ends with
  | Within { least; most } ->
    Some
      (`Assoc [ ("vehicle", `String r.vehicle); ("plan", `String r.plan); ("earliest", seconds_of least);
                ("latest", seconds_of most) ])
  | Some_time | Never -> None

let json_of_over (o : Timed_analysis.outcome) : json =
  let windows = List.map snd o.endings in
  let latest found (w : Timed_analysis.window) =
    match found, w.latest with
    | Timed_analysis.At n, At m -> Timed_analysis.At (max n m)
    | (At _ | Unbounded), _ -> Unbounded
  in
  match windows with
  | [] -> `Null
  | first :: rest ->
    let earliest = List.fold_left (fun least (w : Timed_analysis.window) -> min least w.earliest) first.earliest rest in
    let latest = if o.stopped = None then List.fold_left latest first.latest rest else Unbounded in
    `Assoc
      [ ("earliest", seconds_of earliest);
        ("latest", (match latest with At n -> seconds_of n | Unbounded -> `Null)) ]

(* The page does not need the path of the journal. *)
let from_json from : json =
  match Present.to_json from with
  | `Assoc members -> `Assoc (List.remove_assoc "journal" members)
  | json -> json

let no_outlook e = refusal 422 "no-outlook" (String.concat "; " (Error.sentences e))

let compute (_ : Workspace.t) found =
  let* journal = get Field.text "journal" found in
  let* path = get Field.text "program" found in
  let* of_run = get Field.text "hash" found in
  let of_error result = Result.map_error no_outlook result in
  let* from, program, fleet = of_error (Present.load path ~set:[] ~fleet:None ~journal) in
  let* () =
    if hash program = of_run then Ok ()
    else refuse 409 "changed" "the program has changed since the run began"
  in
  let over = over from program fleet in
  let running = Time_analysis.running ~from in_time program fleet in
  (* Twice: the search with faults may be cut short before it comes to a violation without any. *)
  let* violated, whole = of_error (violations from Faults.none program fleet) in
  let* with_faults, whole_with_faults = of_error (violations from Faults.all program fleet) in
  let by_faults = List.filter (fun p -> not (List.mem p violated)) with_faults in
  let names found = Field.texts (List.map Property.name found) in
  Ok
    (`Assoc
       [ ("from", from_json from); ("over", json_of_over over);
         ("running", `List (List.filter_map json_of_running running)); ("violated", names violated);
         ("by_faults", names by_faults); ("complete", `Bool (whole && whole_with_faults && over.stopped = None)) ])
