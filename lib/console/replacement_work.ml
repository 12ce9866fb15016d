open Dolphin_app
open Dolphin_json
open Exchange

type t = { journal : string; program : Program_file.t }

let own (w : Workspace.t) = Option.to_result ~none:(refusal 409 "no-run" "no run goes on") w.own

let settings w set =
  let* journal = own w in
  Ok (if set = [] then Option.value (Journal_file.settings journal) ~default:[] else set)

let differs (program : Program_file.t) e =
  match Error.diagnostics e with
  | [] -> refusal 422 "differs" (String.concat "; " (Error.sentences e))
  | _ :: _ -> Workspace.of_error ~file:program.path ~source:program.source e

let program w ~set path =
  let* journal = own w in
  let* set = settings w set in
  (* It names no files outside of the folder. *)
  let* program = Workspace.program w ~set path in
  let* _, program, _ = Result.map_error (differs program) (Present.load program.path ~set ~fleet:None ~journal) in
  Ok { journal; program }

let differences w found =
  let* path = get Field.text "program" found in
  let* before = get Field.text "before" found in
  let* set = set found in
  let* set = settings w set in
  let* program = Workspace.program w ~set path in
  Ok (`Assoc [ ("before", `String before); ("after", `String program.source) ])

(* {1 The verdict} *)

let remarks = List.map Dolphin_explore.Property.name (List.filter Exploration.is_remark Dolphin_explore.Property.all)

let of_verdict json =
  let* found = Field.members json in
  let* property = Field.get Field.text "property" found in
  let* verdict = Field.get Field.text "verdict" found in
  Ok (property, verdict)

let outcome result =
  match Result.bind (Field.members result) (Field.get (Field.list of_verdict) "verdicts") with
  | Error _ | Ok [] -> "inconclusive"
  | Ok found ->
    let verdicts = List.map snd (List.filter (fun (property, _) -> not (List.mem property remarks)) found) in
    if List.mem "violated" verdicts then "violated"
    else if List.mem "inconclusive" verdicts then "inconclusive"
    else "holds"

(* {1 The order} *)

(* Of the processor. The process that commands reads the program once more, and serves no Stop meanwhile. *)
let longest = 0.5

let check w found =
  let* path = get Field.text "program" found in
  let* hash = get Field.text "hash" found in
  let* set = set found in
  let* set = settings w set in
  let began = Sys.time () in
  let* program = Workspace.program w ~set path in
  let elapsed = Sys.time () -. began in
  let set = List.map (fun (name, text) -> (name, `String text)) set in
  if elapsed > longest then refuse 413 "too-long" "this program takes too long to read while a run goes on"
  else if (Program_file.header program).hash <> hash then
    refuse 409 "changed" "the program has changed since it was checked"
  else Ok (`Assoc [ ("path", `String program.path); ("hash", `String hash); ("set", `Assoc set) ])
