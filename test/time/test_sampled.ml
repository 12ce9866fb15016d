(* Many simulated runs: those that end do so within the bounds that `dolphin time` gives, in a way that it knows of; how
   many processes make them makes no difference, nor whether they are written as lines and read again. RUNS in the
   environment is how many there are, 20 by default. *)

open Dolphin_app
open Dolphin_time
module Distribution = Dolphin_statistics.Distribution
module Scenario = Dolphin_scenario.Scenario
module Scenario_world = Dolphin_environment.Scenario_world

let runs = match Sys.getenv_opt "RUNS" with Some n -> int_of_string n | None -> 20
let folder = Test_support.Examples.folder
let ok = function Ok x -> x | Error e -> Alcotest.failf "%a" Error.pp e

let load name =
  let path = Filename.concat folder (name ^ ".dol") in
  ok (Program_file.load_with_fleet ~set:[] ~fleet:None path)

let sample ?until ?(runs = runs) ?(each = fun ~seed:_ _ -> ()) ~jobs (program, fleet) =
  let settings : Sampling.settings = { seed = 5; runs = Some runs; until; jobs; answers = [] } in
  ok (Sampling.run ~interrupted:(fun () -> false) ~progress:ignore ~each settings program fleet)

let without_time s = { s with Sampling.seconds = 0.; settings = { s.Sampling.settings with jobs = 0 } }

(* Runs whose lines are written into a file, but for the [left_out]-th, and the result of reading it. *)
let by_lines ?left_out (program, fleet) =
  let header = Sample_lines.header ~version:"test" ~answers:[] program fleet in
  let path = Filename.temp_file "dolphin" ".runs" in
  Fun.protect ~finally:(fun () -> Sys.remove path) (fun () ->
      let channel = open_out_bin path in
      let put line = output_string channel (line ^ "\n") in
      put header;
      let each ~seed run = if Some (seed - 5) <> left_out then put (Sample_lines.of_sample program ~seed run) in
      let made = sample ~each ~jobs:2 (program, fleet) in
      close_out channel;
      (made, Sampling.count ~answers:[] (Sample_lines.read ~header path)))

let sample_by_lines mission =
  let made, read = by_lines mission in
  Alcotest.(check bool) "read as they were made" true (without_time (ok read) = without_time made);
  made

let test_left_out () =
  match by_lines ~left_out:(runs / 2) (load "goals") with
  | _, Error (Error.Bad_input _) -> ()
  | _, (Ok _ | Error _) -> Alcotest.fail "a run is missing"

let time ((program : Program_file.t), (fleet : Fleet_file.t)) =
  let options : Clocked.options =
    { environment =
        Scenario_world.environment ~answers:[] ~faults:Dolphin_environment.Faults.none program.program
          fleet.scenario;
      program = program.program; world = Scenario_world.world fleet.scenario;
      durations = Durations.of_scenario fleet.scenario;
      dates = Dolphin_semantics.Dated_code.named program.program }
  in
  Timed_analysis.run { Dolphin_checker.Limits.none with max_states = Some 2_000 } options

(* Things that {!Durations} does not know: vehicles that leave, and batteries. *)
let is_steady (s : Scenario.t) =
  List.for_all (fun (v : Scenario.vehicle) -> v.leaves = None && v.drops = []) s.vehicles

let compared = ref 0

let check_bounds (o : Timed_analysis.outcome) (s : Sampling.t) =
  let ending (e : Sampling.ending) =
    let known : Timed_system.ending =
      match e.ending with
      | Completed -> Completed
      | Halted _ -> Halted
      | Failed _ -> Failed
      | Stuck _ -> Alcotest.fail "a run that is stuck, which no run is"
    in
    if not (List.mem_assoc known o.endings) then Alcotest.fail "an end that no run has"
  in
  List.iter ending s.endings;
  Alcotest.(check int) "each run ends" runs (List.fold_left (fun n (e : Sampling.ending) -> n + e.runs) 0 s.endings);
  match List.assoc_opt Timed_system.Completed o.endings with
  | Some w when not (Distribution.is_empty s.completed) ->
    incr compared;
    let check q =
      let ms = Option.get (Bounds.milliseconds (Distribution.quantile q s.completed)) in
      let is_early = match w.latest with At latest -> ms <= latest + 1 | Unbounded -> true in
      Alcotest.(check bool) (Printf.sprintf "%d ms" ms) true (w.earliest - 1 <= ms && is_early)
    in
    List.iter check [ 0.; 0.05; 0.5; 0.95; 1. ]
  | Some _ | None -> ()

let check_example name () =
  let _, (fleet : Fleet_file.t) as mission = load name in
  if is_steady fleet.scenario then begin
    let o = time mission in
    if o.stopped = None && o.endless = None then check_bounds o (sample_by_lines mission)
  end

let test_processes () =
  let mission = load "goals" in
  let one = without_time (sample ~jobs:1 mission) in
  List.iter
    (fun jobs -> Alcotest.(check bool) (string_of_int jobs) true (without_time (sample ~jobs mission) = one))
    [ 2; 3; 7 ];
  let until ~jobs = without_time (sample ~until:0.1 ~runs:1_000 ~jobs mission) in
  Alcotest.(check bool) "until it is known" true (until ~jobs:1 = until ~jobs:3 && (until ~jobs:3).stop = Known)

(* With seconds that are the same in each run: the counts can be foretold. *)
let test_counts () =
  let folder = Filename.get_temp_dir_name () in
  let path = Filename.concat folder (Printf.sprintf "sampled-%d.dol" (Unix.getpid ())) in
  let write path text =
    let channel = open_out_bin path in
    output_string channel text;
    close_out channel
  in
  let fleet = Filename.remove_extension path ^ ".fleet" in
  write path
    "v = pick { id 'a' }\n\
     n = 0\n\
     execute v: watch (\n\
     watch imcPlan('bad') onError { e -> n = n + 1; if (n < 3) retry() else propagate() }\n\
     ) onError { ignore() } >> (imcPlan('good') during 10)\n\
     halt 'over'\n";
  write fleet "vehicle 'a', { type 'UUV' }\nplan 'bad', { duration 60; fails }\nplan 'good', { duration 60 }\n";
  let remove () = List.iter Sys.remove [ path; fleet ] in
  Fun.protect ~finally:remove (fun () ->
      let s = sample_by_lines (ok (Program_file.load_with_fleet ~set:[] ~fleet:None path)) in
      let task (t : Sampling.task) =
        (t.task.name, [ t.counts.began; t.counts.ended; t.counts.failed; t.counts.stopped; t.failing ]) in
      Alcotest.(check (list (pair string (list int)))) "tasks"
        [ ("bad", [ 3 * runs; 0; 3 * runs; 0; runs ]); ("good", [ runs; 0; 0; runs; 0 ]) ]
        (List.map task s.tasks);
      (* The inner handler runs three times, the outer one after the third. *)
      Alcotest.(check (list (pair int int))) "handlers" [ (3 * runs, runs); (runs, runs) ]
        (List.sort (fun a b -> compare b a) (List.map (fun (h : Sampling.handler) -> (h.ran, h.runs)) s.handlers));
      match s.endings with
      | [ { ending = Halted "over"; runs = n; seed = 5 } ] when n = runs -> ()
      | _ -> Alcotest.fail "all halt")

let () =
  let case name = Alcotest.test_case name `Quick (check_example name) in
  Alcotest.run "sampled"
    [ ("examples", List.map case (Test_support.Examples.with_fleets ()));
      ("all of them",
       [ Alcotest.test_case "processes" `Quick test_processes; Alcotest.test_case "counts" `Quick test_counts;
         Alcotest.test_case "a line is left out" `Quick test_left_out;
         Alcotest.test_case "many were compared" `Quick (fun () ->
             Alcotest.(check bool) "most" true (!compared > 20)) ]) ]
