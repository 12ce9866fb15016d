open Dolphin_app
open Dolphin_semantics
open Dolphin_trace
open Lwt.Infix
module Scenario_world = Dolphin_environment.Scenario_world
module Log = Dolphin_display.Log

type kind = Exploration | Timing of { deadline : string option } | Graph of { states : int }
type order = { kind : kind; faults : string option; seconds : int }
type state = Running | Cancelled | Over of (Yojson.Safe.t, string) result

type t = {
  order : order;
  program : Program_file.t;
  hash : string;  (* of its file *)
  fleet : Fleet_file.t;
  process : Lwt_process.process_full;
  changed : unit -> unit;
  witness : string;  (* the file of the run that is shown *)
  finished : unit Lwt.t;
  finish : unit Lwt.u;
  mutable progress : string;
  mutable state : state;
  mutable steps : Yojson.Safe.t;
  mutable found : Witness.t option;
}

let program e = e.program
let goes_on e = match e.state with Running -> true | Cancelled | Over _ -> false
let finished e = Lwt.protected e.finished

(* {1 The counterexample} *)

let step (program : Program_file.t) (before, log, number, made) ((t : Transition.t), date) =
  let members = Step.members (Step.of_transition program.program before t) in
  let log, lines = Log.transition log ~time:0. t in
  let words = String.concat "\n" (List.map (fun (l : Log.line) -> String.trim l.text) lines) in
  (* The log's columns begin with a time, which there is none of here. *)
  let without_time text =
    if String.length text > 4 && String.sub text 0 4 = "0:00" then
      String.trim (String.sub text 4 (String.length text - 4))
    else text
  in
  let json : Yojson.Safe.t =
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

let counterexample (program : Program_file.t) (fleet : Fleet_file.t) witness ~dates : Yojson.Safe.t =
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

(* {1 The process} *)

let last_line text =
  match List.rev (List.filter (( <> ) "") (String.split_on_char '\n' text)) with line :: _ -> line | [] -> ""

let result e text =
  Yojson.Safe.from_string (match e.order.kind with Graph _ -> text | Exploration | Timing _ -> last_line text)

let rec follow_progress e told =
  Lwt_io.read_line_opt e.process#stderr >>= function
  | None -> Lwt.return (List.rev told)
  | Some line ->
    e.progress <- line;
    e.changed ();
    follow_progress e (if List.length told < 100 then line :: told else told)

let over e text told =
  let result =
    match result e text with
    | json -> Ok json
    | exception Yojson.Json_error _ -> Error (if told = [] then "there is no result" else String.concat "\n" told)
  in
  if Sys.file_exists e.witness then begin
    (match Witness_file.read e.witness with
     | Ok witness ->
       let dates = Result.fold result ~ok:dates_of ~error:(fun _ -> []) in
       e.steps <- counterexample e.program e.fleet witness ~dates;
       e.found <- Some witness
     | Error _ -> ());
    Sys.remove e.witness
  end;
  if e.state = Running then e.state <- Over result;
  e.changed ();
  Lwt.wakeup_later e.finish ()

let arguments order ~witness =
  let seconds = string_of_int order.seconds in
  let of_kind =
    match order.kind with
    | Exploration -> [ "explore"; "--json"; "--progress"; "1"; "--timeout"; seconds; "--trace"; witness ]
    | Timing { deadline } ->
      [ "time"; "--json"; "--timeout"; seconds; "--trace"; witness ]
      @ Option.fold deadline ~none:[] ~some:(fun time -> [ "--deadline=" ^ time ])
    | Graph { states } -> [ "lts"; "--format"; "json"; "--max-states"; string_of_int states ]
  in
  of_kind @ Option.fold order.faults ~none:[] ~some:(fun faults -> [ "--faults=" ^ faults ])

let inputs (program : Program_file.t) (fleet : Fleet_file.t) =
  let set = List.concat_map (fun (name, value) -> [ "--set"; name ^ "=" ^ value ]) program.set in
  let fleet = Option.fold fleet.path ~none:[] ~some:(fun path -> [ "--fleet"; path ]) in
  fleet @ set @ [ "--"; program.path ]

let start ~dolphin ~changed order (program : Program_file.t) (fleet : Fleet_file.t) =
  let witness = Filename.temp_file "dolphin-console" ".witness" in
  Sys.remove witness;
  let command = (dolphin :: arguments order ~witness) @ inputs program fleet in
  let process = Lwt_process.open_process_full (dolphin, Array.of_list command) in
  let finished, finish = Lwt.wait () in
  let digest text = Digest.to_hex (Digest.string text) in
  let hash = Result.fold (Text_file.read program.path) ~ok:digest ~error:(fun _ -> "") in
  let e =
    { order; program; hash; fleet; process; changed; witness; finished; finish; progress = ""; state = Running;
      steps = `Null; found = None }
  in
  let whole () =
    Lwt_io.close process#stdin >>= fun () ->
    Lwt.both (Lwt_io.read process#stdout) (follow_progress e []) >>= fun (text, told) ->
    process#close >|= fun _ -> over e text told
  in
  let failed error = over e "" [ Printexc.to_string error ]; Lwt.return_unit in
  Lwt.async (fun () -> Lwt.catch whole failed);
  e

let shown e = Option.map (fun witness -> (e.program, e.fleet, witness)) e.found

let cancel e =
  if goes_on e then begin
    e.state <- Cancelled;
    e.process#terminate;
    e.changed ()
  end

let to_json e : Yojson.Safe.t =
  let state, more =
    match e.state with
    | Running -> ("running", [])
    | Cancelled -> ("cancelled", [])
    | Over (Ok json) -> ("over", [ ("result", json); ("counterexample", e.steps) ])
    | Over (Error why) -> ("failed", [ ("error", `String why) ])
  in
  `Assoc ([ ("hash", `String e.hash); ("state", `String state); ("progress", `String e.progress) ] @ more)
