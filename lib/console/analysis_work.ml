open Dolphin_app
open Dolphin_json
open Dolphin_trace
open Dolphin_semantics
open Field
open Exchange
module Request = Dolphin_http.Request
module Scenario_world = Dolphin_environment.Scenario_world
module Log = Dolphin_display.Log

let longest = 3600
let most_states = 2_000

(* {1 What is asked} *)

let within what least most n =
  if n >= least && n <= most then Ok () else bad (Printf.sprintf "%s from %d to %d" what least most)

let of_subject subject found =
  match (subject : Analysis.subject) with
  | Exploration -> Ok [ "explore"; "--json"; "--progress"; "1" ]
  | Replacement -> Ok [ "explore"; "--json"; "--progress"; "1" ]
  | Timing ->
    let* deadline = optional Field.text "deadline" found in
    Ok ([ "time"; "--json" ] @ Option.fold deadline ~none:[] ~some:(fun time -> [ "--deadline=" ^ time ]))
  | Graph ->
    let* states = optional whole "states" found in
    let states = Option.value states ~default:300 in
    let* () = within "a graph has states" 1 most_states states in
    Ok [ "lts"; "--format"; "json"; "--max-states"; string_of_int states ]

(* The program with its fleet; the former for a run that goes on has that of the run. *)
let loaded subject (w : Workspace.t) found ~set path =
  match (subject : Analysis.subject) with
  | Replacement ->
    let* { Replacement_work.journal; program } = Replacement_work.program w ~set path in
    Ok ([ "--from"; journal ], Analysis.inputs program Fleet_file.nobody, program, None)
  | Exploration | Timing | Graph ->
    let* named = optional Field.text "fleet" found in
    let* program, fleet = Workspace.program_in_fleet w ~set ~fleet:named path in
    Ok ([], Analysis.inputs program fleet, program, fleet.path)

(* A run goes on with the program as it was checked, with its included files. *)
let hash_of subject (program : Program_file.t) =
  match (subject : Analysis.subject) with
  | Replacement -> (Program_file.header program).hash
  | Exploration | Timing | Graph -> Result.fold (Text_file.read program.path) ~ok:Files.hash ~error:(fun _ -> "")

let prepare subject (w : Workspace.t) found =
  let* path = get Field.text "program" found in
  let* seconds = optional whole "seconds" found in
  let* faults = optional Field.text "faults" found in
  let* set = set found in
  let* arguments = of_subject subject found in
  let seconds = Option.value seconds ~default:60 in
  let* () = within "it takes seconds" 1 longest seconds in
  let* from, inputs, program, fleet = loaded subject w found ~set path in
  let faults = Option.fold faults ~none:[] ~some:(fun faults -> [ "--faults=" ^ faults ]) in
  Ok
    (Analysis.json_of_order
       { subject; seconds; arguments = arguments @ from @ faults; inputs; program = path; fleet; set;
         hash = hash_of subject program })

(* {1 The counterexample} *)

let step (program : Program_file.t) (before, log, number, made) ((t : Transition.t), date) =
  let members = Step.members (Step.of_transition program.program before t) in
  let log, lines = Log.transition log ~time:0. t in
  let words = String.concat "\n" (List.map (fun (l : Log.line) -> String.trim l.text) lines) in
  (* The log's columns begin with a time, which does not exist here. *)
  let without_time text =
    if String.length text > 4 && String.sub text 0 4 = "0:00" then
      String.trim (String.sub text 4 (String.length text - 4))
    else text
  in
  let json : json =
    `Assoc
      ([ ("kind", `String "transition"); ("time", Option.value date ~default:(`Int number)); ("i", `Int number);
         ("words", `String (without_time words)) ] @ members)
  in
  (t.next, log, number + 1, json :: made)

(* Each step with its date, if dates are known. *)
let rec dated steps dates =
  match steps, dates with
  | t :: steps, date :: dates -> (t, Some date) :: dated steps dates
  | steps, _ -> List.map (fun t -> (t, None)) steps

let counterexample (program : Program_file.t) (fleet : Fleet_file.t) witness ~dates : json =
  let world = Scenario_world.world fleet.scenario in
  match Witness.follow program.program world witness with
  | Error _ -> `Null
  | Ok (steps, cycle) ->
    let initial = (Configuration.initial program.program, Log.start, 0, []) in
    let all = if cycle = [] then dated steps dates else dated (steps @ cycle) [] in
    let _, _, _, made = List.fold_left (step program) initial all in
    `Assoc
      [ ("property", `String witness.property); ("cycle", `Int (List.length cycle));
        ("dated", `Bool (cycle = [] && dates <> [])); ("steps", `List (List.rev made)) ]

(* The dates of the run that dolphin time shows. *)
let dates_of result =
  let member json name = match json with `Assoc _ -> Yojson.Safe.Util.member name json | _ -> `Null in
  match List.fold_left member result [ "shown"; "run"; "dates" ] with `List dates -> dates | _ -> []

(* {1 What was found} *)

let last_line text =
  match List.rev (List.filter (( <> ) "") (String.split_on_char '\n' text)) with line :: _ -> line | [] -> ""

let result subject text =
  let printed =
    match (subject : Analysis.subject) with
    | Graph -> text
    | Exploration | Timing | Replacement -> last_line text
  in
  match Yojson.Safe.from_string printed with
  | json -> Ok json
  | exception Yojson.Json_error _ -> refuse 422 "no-result" "there is no result"

(* The program and the fleet as the command had them: those on the disk, unless they have changed since. *)
let same (source : Header.source) (now : Header.source) = source.hash = now.hash

let witnessed w (order : Analysis.order) (witness : Witness.t) =
  let* program, fleet = Workspace.program_in_fleet w ~set:order.set ~fleet:None order.program in
  let* fleet =
    match order.fleet with
    | Some path when fleet.path <> Some path -> Workspace.fleet { w with fleet = Some path } ~program:program.path None
    | Some _ | None -> Ok fleet
  in
  let* program = Workspace.within fleet program in
  let is_fleet = Option.equal same witness.fleet (Fleet_file.header fleet) in
  if same witness.program (Program_file.header program) && is_fleet then Ok (program, fleet)
  else refuse 409 "changed" "the program or the fleet has changed since it was analysed"

let conclude w (r : Request.t) =
  let* text = parameter r "order" in
  let* order = Result.bind (needed (Host_value.parse text)) Analysis.order_of_json in
  let* result = result order.subject r.body in
  let outcome : Field.members =
    match order.subject with
    | Replacement -> [ ("outcome", `String (Replacement_work.outcome result)) ]
    | Exploration | Timing | Graph -> []
  in
  let shown =
    match Option.map Witness_file.read (Request.parameter r "witness") with
    | Some (Ok witness) -> (
        match witnessed w order witness with
        | Ok (program, fleet) -> counterexample program fleet witness ~dates:(dates_of result)
        | Error _ -> `Null)
    | Some (Error _) | None -> `Null
  in
  Ok (`Assoc (outcome @ [ ("result", result); ("counterexample", shown) ]))
