open Dolphin_results
open Dolphin_json.Field

type json = Yojson.Safe.t

type seen = {
  label : string;
  event : json option;
  world : json option;
  now : int option;
  rule : string list option;
  effects : json list option;
  running : (string * string) list option;
  bound : string list option;
  pairs : string list option;
  store : (string * string) list option;
  ending : (string * string option) option;
}

type step = Until of string | Step of seen
type outcome = { how : string; message : string option; left : string list }

type expectation =
  | Rejected of (string * int option) list
  | Trace of step list
  | Outcomes of outcome list
  | Deadlock of bool
  | Admits of step list
  | Forbids of step list
  | Times of Timed_data.times
  | Dated of { run : (int * Yojson.Safe.t) list; findings : Timed_data.finding list }

type environment = {
  fails : string list;
  may_fail : string list;
  answers : (string * string list) list;
  replies : json list;
  interruption : bool;
  faults : string;
}

type t = {
  path : string;
  title : string;
  covers : string list;
  program : string;
  fleet : string;
  environment : environment;
  expectations : expectation list;
  fails : string list;
}

let kind = function
  | Rejected _ -> "rejected"
  | Trace _ -> "trace"
  | Outcomes _ -> "outcomes"
  | Deadlock _ -> "deadlock"
  | Admits _ -> "admits"
  | Forbids _ -> "forbids"
  | Times _ -> "times"
  | Dated _ -> "dated"

(* {1 Members} *)

let known names found =
  match List.find_opt (fun (name, _) -> not (List.mem name names)) found with
  | Some (name, _) -> Error (Printf.sprintf "unknown member %S; known are %s" name (String.concat ", " names))
  | None -> Ok found

let members_of names json = Result.bind (members json) (known names)
let some read json = Result.map Option.some (read json)
let maybe read name found = optional (some read) ~default:None name found
let sorted read json = Result.map (List.sort compare) (read json)

let texts_by_name json =
  let* found = members json in
  Result.map (List.sort compare) (Results.map_values text found)

let lines json = Result.map (String.concat "\n") (list text json)

let ending json =
  let* found = members_of [ "ending"; "message" ] json in
  let* how = get text "ending" found in
  let* message = maybe text "message" found in
  Ok (how, message)

(* {1 Steps} *)

let seen found =
  let* label = get text "label" found in
  let* event = maybe any "event" found in
  let* world = maybe any "world" found in
  let* now = maybe whole "now" found in
  let* rule = maybe (list text) "rule" found in
  let* effects = maybe (list any) "effects" found in
  let* running = maybe texts_by_name "A" found in
  let* bound = maybe (list text) "B" found in
  let* pairs = maybe (sorted (list text)) "N" found in
  let* store = maybe texts_by_name "store" found in
  let* ending = maybe ending "end" found in
  Ok (Step { label; event; world; now; rule; effects; running; bound; pairs; store; ending })

let step (json : json) =
  match json with
  | `String label -> seen [ ("label", `String label) ]
  | `Assoc [ ("until", json) ] -> Result.map (fun label -> Until label) (text json)
  | json ->
    let names = [ "label"; "event"; "world"; "now"; "rule"; "effects"; "A"; "B"; "N"; "store"; "end" ] in
    Result.bind (members_of names json) seen

let trace = list step

(* {1 Expectations} *)

let rejection (json : json) =
  match json with
  | `String code -> Ok (code, None)
  | json ->
    let* found = members_of [ "code"; "line" ] json in
    let* code = get text "code" found in
    let* line = maybe whole "line" found in
    Ok (code, line)

let outcome json =
  let* found = members_of [ "ending"; "message"; "N" ] json in
  let* how = get text "ending" found in
  let* message = maybe text "message" found in
  let* left = optional (sorted (list text)) ~default:[] "N" found in
  Ok { how; message; left }

let times json = Result.bind (members_of [ "ends"; "tasks"; "endless"; "missed" ] json) Timed_data.times

let dated json =
  let* found = members_of [ "run"; "findings" ] json in
  let* run = get (list Timed_data.dated) "run" found in
  let* findings = optional Timed_data.findings ~default:[] "findings" found in
  Ok (Dated { run; findings })

let expectation (name, json) =
  let one make read = Result.map (fun x -> [ make x ]) (read json) in
  let several make read = Result.map (List.map make) (list read json) in
  Result.map_error
    (Printf.sprintf "expect.%s: %s" name)
    (match name with
     | "rejected" -> one (fun rs -> Rejected rs) (sorted (list rejection))
     | "trace" -> one (fun steps -> Trace steps) trace
     | "outcomes" -> one (fun outcomes -> Outcomes outcomes) (list outcome)
     | "deadlock" -> one (fun b -> Deadlock b) truth
     | "admits" -> several (fun steps -> Admits steps) trace
     | "forbids" -> several (fun steps -> Forbids steps) trace
     | "times" -> one (fun times -> Times times) times
     | "dated" -> list dated json
     | _ -> Error "this expectation is not known")

let expectations json =
  let* found = members json in
  let* all = Results.concat_map expectation found in
  if all = [] then Error "nothing is expected" else Ok all

(* Of answers to one prompt, the last ones hold. *)
let answers json =
  let* found = members json in
  Result.map List.rev (Results.map_values (list text) found)

let nothing = { fails = []; may_fail = []; answers = []; replies = []; interruption = false; faults = "" }

let environment json =
  let* found = members_of [ "fails"; "mayFail"; "answers"; "replies"; "interruption"; "faults" ] json in
  let* fails = optional (list text) ~default:[] "fails" found in
  let* may_fail = optional (list text) ~default:[] "mayFail" found in
  let* answers = optional answers ~default:[] "answers" found in
  let* replies = optional (list any) ~default:[] "replies" found in
  let* interruption = optional truth ~default:false "interruption" found in
  let* faults = optional text ~default:"" "faults" found in
  Ok { fails; may_fail; answers; replies; interruption; faults }

let of_json path json =
  let* found = members_of [ "title"; "covers"; "program"; "fleet"; "environment"; "expect"; "fails" ] json in
  let* title = get text "title" found in
  let* covers = optional (list text) ~default:[] "covers" found in
  let* program = get lines "program" found in
  let* fleet = get lines "fleet" found in
  let* environment = optional environment ~default:nothing "environment" found in
  let* expected = get any "expect" found in
  let* expectations = expectations expected in
  let* fails = optional (sorted (list text)) ~default:[] "fails" found in
  Ok { path; title; covers; program; fleet; environment; expectations; fails }

let of_string ~path source =
  match Dolphin_json.Host_value.parse source with
  | Error why -> Error ("this is not JSON: " ^ why)
  | Ok json -> of_json path json
