open Dolphin_app
open Dolphin_semantics
open Dolphin_trace
open Lwt.Infix
module Scenario_world = Dolphin_environment.Scenario_world
module Log = Dolphin_display.Log

type state = Running | Cancelled | Over of (Yojson.Safe.t, string) result

type t = {
  program : Program_file.t;
  fleet : Fleet_file.t;
  process : Lwt_process.process_full;
  changed : unit -> unit;
  witness : string;  (* the file of the counterexample *)
  finished : unit Lwt.t;
  finish : unit Lwt.u;
  mutable progress : string;
  mutable state : state;
  mutable steps : Yojson.Safe.t;
}

let goes_on e = match e.state with Running -> true | Cancelled | Over _ -> false
let finished e = Lwt.protected e.finished

(* {1 The counterexample} *)

let step (program : Program_file.t) (before, log, number, made) (t : Transition.t) =
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
      ([ ("kind", `String "transition"); ("time", `Int number); ("i", `Int number);
         ("words", `String (without_time words)) ] @ members)
  in
  (t.next, log, number + 1, json :: made)

let counterexample (program : Program_file.t) (fleet : Fleet_file.t) witness : Yojson.Safe.t =
  let world = Scenario_world.world fleet.scenario in
  match Witness.follow program.program world witness with
  | Error _ -> `Null
  | Ok (steps, cycle) ->
    let initial = (Configuration.initial program.program, Log.start, 0, []) in
    let _, _, _, made = List.fold_left (step program) initial (steps @ cycle) in
    `Assoc
      [ ("property", `String witness.property); ("cycle", `Int (List.length cycle)); ("steps", `List (List.rev made)) ]

(* {1 The process} *)

let last_line text =
  match List.rev (List.filter (( <> ) "") (String.split_on_char '\n' text)) with line :: _ -> line | [] -> ""

let rec follow_progress e told =
  Lwt_io.read_line_opt e.process#stderr >>= function
  | None -> Lwt.return (List.rev told)
  | Some line ->
    e.progress <- line;
    e.changed ();
    follow_progress e (if List.length told < 100 then line :: told else told)

let over e text told status =
  let result =
    match (status : Unix.process_status), Yojson.Safe.from_string (last_line text) with
    | _, json -> Ok json
    | exception Yojson.Json_error _ ->
      Error (if told = [] then "explore ended without verdicts" else String.concat "\n" told)
  in
  if Sys.file_exists e.witness then begin
    (match Witness_file.read e.witness with
     | Ok witness -> e.steps <- counterexample e.program e.fleet witness
     | Error _ -> ());
    Sys.remove e.witness
  end;
  if e.state = Running then e.state <- Over result;
  e.changed ();
  Lwt.wakeup_later e.finish ()

let start ~dolphin ~changed ~seconds (program : Program_file.t) (fleet : Fleet_file.t) =
  let witness = Filename.temp_file "dolphin-console" ".witness" in
  Sys.remove witness;
  let fleet_options = Option.fold fleet.path ~none:[] ~some:(fun path -> [ "--fleet"; path ]) in
  let set = List.concat_map (fun (name, value) -> [ "--set"; name ^ "=" ^ value ]) program.set in
  let command =
    [ dolphin; "explore"; "--json"; "--progress"; "1"; "--timeout"; string_of_int seconds; "--trace"; witness ]
    @ fleet_options @ set @ [ "--"; program.path ]
  in
  let process = Lwt_process.open_process_full (dolphin, Array.of_list command) in
  let finished, finish = Lwt.wait () in
  let e =
    { program; fleet; process; changed; witness; finished; finish; progress = ""; state = Running; steps = `Null } in
  let whole () =
    Lwt_io.close process#stdin >>= fun () ->
    Lwt.both (Lwt_io.read process#stdout) (follow_progress e []) >>= fun (text, told) ->
    process#close >|= over e text told
  in
  let failed error = over e "" [ Printexc.to_string error ] (WEXITED 1); Lwt.return_unit in
  Lwt.async (fun () -> Lwt.catch whole failed);
  e

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
  `Assoc ([ ("state", `String state); ("progress", `String e.progress) ] @ more)
