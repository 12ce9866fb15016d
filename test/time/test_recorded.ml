(* Simulated runs lie within the bounds of the timed semantics: of all examples, with several seeds, each run ends,
   and each task starts and ends, when it may; no task or timer takes longer or shorter than it may. SEEDS in the
   environment is how many seeds are tried, 8 by default. *)

open Dolphin_semantics
open Dolphin_runtime
open Dolphin_time
module Scenario = Dolphin_scenario.Scenario
module Simulator = Dolphin_platform_sim.Simulator
module Environment = Dolphin_environment.Environment
module Scenario_world = Dolphin_environment.Scenario_world
module Platform = Simulator.Virtual
module Answering = Test_support.Answering

let seeds = match Sys.getenv_opt "SEEDS" with Some n -> int_of_string n | None -> 8
let folder = Test_support.Examples.folder

let read_file path =
  let channel = open_in_bin path in
  let text = really_input_string channel (in_channel_length channel) in
  close_in channel;
  text

exception Enough

let most_steps = 2_000

(* The transitions of a run, each with its date and its cause. *)
let run ~seed scenario program =
  let taken = ref [] and left = ref most_steps in
  let transition ~time ~cause t =
    decr left;
    if !left = 0 then raise Enough;
    taken := (Option.get (Bounds.milliseconds time), cause, t) :: !taken
  in
  let whole () =
    Driver.run (module Platform) (Platform.create ~seed scenario) ~observer:{ Observer.nobody with transition }
      ~host:(Answering.host scenario) ~console:(Answering.console scenario) ~interruption:(fst (Lwt.wait ())) program
  in
  (match Lwt_main.run (whole ()) with Ended _ | Stuck _ | Spins _ -> () | exception Enough -> ());
  List.rev !taken

let follow options run =
  let next (r, found) (date, on, t) =
    let r, more = Recorded.transition r ~date ~on t in
    (r, found @ more)
  in
  snd (List.fold_left next (Recorded.start ~tolerance:0 options, []) run)

(* What {!Durations} does not know of: who leaves, and batteries. *)
let is_steady (s : Scenario.t) =
  List.for_all (fun (v : Scenario.vehicle) -> v.leaves = None && v.drops = []) s.vehicles

let is_within (w : Timing.window) date =
  date >= w.earliest - 1 && (match w.latest with At latest -> date <= latest + 1 | Unbounded -> true)

(* The dates of a run against what is said of all runs. *)
let check_dates name (o : Timing.outcome) run =
  let ending : Configuration.ending -> Timed_system.ending option = function
    | Completed -> Some Completed
    | Halted _ -> Some Halted
    | Failed _ -> Some Failed
    | Interrupted -> None
  in
  let check_window what windows date =
    match windows with
    | Some w when is_within w date -> ()
    | Some (_ : Timing.window) -> Alcotest.failf "%s: %s at %d ms, which is not within its bounds" name what date
    | None -> Alcotest.failf "%s: %s, which no run does" name what
  in
  let of_task v (p : Core.platform_task) moment date =
    let task : Timing.task = { name = p.name; vehicle = v; site = p.task_site } in
    check_window (p.name ^ " on " ^ v) (Option.bind (List.assoc_opt task o.tasks) (List.assoc_opt moment)) date
  in
  let step allocation (date, _, (t : Transition.t)) =
    let start : Effect.t -> unit = function Start (v, p) -> of_task v p Starts date | _ -> () in
    List.iter start t.effects;
    let running v f = Option.iter f (Vehicle_map.find_opt v allocation) in
    (match t.label, t.next.control with
     | Done (v, _), _ -> running v (fun p -> of_task v p Ends date)
     | Fail (v, _, _), _ -> running v (fun p -> of_task v p Fails date)
     | _, Ended e ->
       Option.iter (fun e -> check_window "the end" (List.assoc_opt e o.endings) date) (ending e)
     | _, _ -> ());
    t.next.shared.allocation
  in
  ignore (List.fold_left step Vehicle_map.empty run)

let limits = { Dolphin_checker.Limits.none with max_states = Some 2_000 }
let compared = ref 0

let check_example name () =
  let scenario =
    match Scenario.read ~file:name (read_file (Filename.concat folder (name ^ ".fleet"))) with
    | Ok scenario -> scenario
    | Error _ -> Alcotest.fail "the fleet is wrong"
  in
  let program = Test_support.Pure_run.compile_exn (read_file (Filename.concat folder (name ^ ".dol"))) in
  let options : Timed.options =
    { environment = Scenario_world.environment ~answers:[] ~faults:Dolphin_environment.Faults.none program scenario;
      program;
      world = Scenario_world.world scenario; durations = Durations.of_scenario scenario;
      dates = Dolphin_semantics.Dated_code.named program }
  in
  if is_steady scenario then begin
    let o = Timing.run limits options in
    for seed = 1 to seeds do
      let run = run ~seed scenario program in
      (match follow options run with
       | [] -> ()
       | { pending; began; seen; _ } :: _ ->
         let what = match pending.task with Some p -> p.name | None -> "a timer" in
         Alcotest.failf "seed %d: %s from %d to %d ms is outside of its bounds" seed what began seen);
      if o.stopped = None then begin incr compared; check_dates name o run end
    done
  end

(* A plan that takes longer than the fleet says, or shorter, is found. *)
let test_findings () =
  let fleet duration =
    Result.get_ok
      (Scenario.read ~file:"f" ("vehicle 'a', { type 'UUV' }\nplan 'p', { duration " ^ duration ^ " }\n")) in
  let program = Test_support.Pure_run.compile_exn "va = pick { id 'a' }\nexecute task('p')[va] >> idle(5)\n" in
  let options scenario : Timed.options =
    { environment = Scenario_world.environment ~answers:[] ~faults:Dolphin_environment.Faults.none program scenario;
      program; world = Scenario_world.world scenario; durations = Durations.of_scenario scenario;
      dates = Dolphin_semantics.Dated_code.named program } in
  let run = run ~seed:1 (fleet "50, 60") program in
  let found duration = List.map (fun (f : Recorded.finding) -> f.too_early) (follow (options (fleet duration)) run) in
  Alcotest.(check (list bool)) "as it is" [] (found "50, 60");
  Alcotest.(check (list bool)) "too late" [ false ] (found "20, 30");
  Alcotest.(check (list bool)) "too early" [ true ] (found "100, 110");
  let put_off (date, on, t) =
    ((match on with Some (Transition.Timer_expired _) -> date + 9_000 | Some _ | None -> date), on, t) in
  let late = List.map put_off run in
  Alcotest.(check (list bool)) "a timer" [ false ]
    (List.map (fun (f : Recorded.finding) -> f.too_early) (follow (options (fleet "50, 60")) late))

let () =
  let case name = Alcotest.test_case name `Quick (check_example name) in
  Alcotest.run "recorded"
    [ ("examples", List.map case (Test_support.Examples.with_fleets ()));
      ("findings", [ Alcotest.test_case "too early and too late" `Quick test_findings;
                     Alcotest.test_case "many were compared" `Quick (fun () ->
                         Alcotest.(check bool) "most" true (!compared > 20 * seeds)) ]) ]
