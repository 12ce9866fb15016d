open Dolphin_time
module Replay = Dolphin_trace.Replay
module Scenario_world = Dolphin_environment.Scenario_world

let text p (f : Dated_run.finding) =
  let time = Fmt.to_to_string Bounds.pp_time in
  let least, most =
    match f.pending.bounds with Within { least; most } -> (least, most) | Some_time | Never -> (0, 0) in
  let what = Time_report.item ?at:f.at p f.pending in
  if f.too_early then
    Printf.sprintf "%s: %s was over after %s, and takes %s at least" (time f.seen) what (time (f.seen - f.began))
      (time least)
  else
    Printf.sprintf "%s: %s was not over before %s, and takes %s at most" (time f.seen) what (time (f.seen - f.began))
      (time most)

(* Virtual time is exact; links and clocks are not. *)
let usual = 1_000

let usual_of (header : Dolphin_trace.Header.t) =
  match header with { platform = "sim"; speed = None; _ } -> 0 | _ -> usual

let check ?tolerance (p : Program_file.t) (fleet : Fleet_file.t) path =
  let options : Clocked.options =
    { environment =
        Scenario_world.environment ~answers:[] ~faults:Dolphin_environment.Faults.none p.program fleet.scenario;
      program = p.program; world = Scenario_world.still fleet.scenario;
      durations = Durations.of_scenario fleet.scenario; dates = Ok Dolphin_semantics.Dated_code.no_dates }
  in
  let replay = ref (Replay.start ~hash:(Program_file.header p).hash p.program) in
  let recorded = ref (Dated_run.start ~tolerance:usual options) and findings = ref [] in
  let take time (on, t) =
    let date = Option.value (Bounds.milliseconds time) ~default:0 in
    let next, found = Dated_run.transition !recorded ~date ~on t in
    recorded := next;
    findings := List.rev_append (List.map (text p) found) !findings
  in
  let tolerate ms = recorded := Dated_run.with_tolerance (Option.value tolerance ~default:ms) !recorded in
  let line (entry : Dolphin_trace.Entry.t) =
    (match entry with
     | Header header -> tolerate (usual_of header)
     | Resumed _ -> tolerate usual
     | Vehicle { time; state } ->
       let date = Option.value (Bounds.milliseconds time) ~default:0 in
       recorded := Dated_run.heard !recorded ~date state.id state.connected
     | _ -> ());
    match Replay.feed !replay entry with
    | Ok next -> replay := next; Option.iter (take (Dolphin_trace.Entry.time entry)) (Replay.latest next)
    | Error _ -> ()  (* reported after the check that it is a run *)
  in
  Result.map (fun () -> List.rev !findings) (Journal_file.iter line path)
