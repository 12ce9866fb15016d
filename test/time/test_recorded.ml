(* Simulated runs lie within the bounds of the timed semantics: of all examples, with several seeds, each run ends,
   and each task starts and ends, when it may; no task or timer takes longer or shorter than it may. SEEDS in the
   environment is how many seeds are tried, 8 by default; PROGRAMS is how many programs with links that come and go, 200
   by default. *)

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
let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 200
let folder = Test_support.Examples.folder

let read_file path =
  let channel = open_in_bin path in
  let text = really_input_string channel (in_channel_length channel) in
  close_in channel;
  text

exception Enough

let most_steps = 2_000

type line = Taken of Transition.event option * Transition.t | Heard of Core.vehicle * bool

(* The transitions of a run, each with its date and its cause, and the news of links. *)
let run ~seed scenario program =
  let taken = ref [] and left = ref most_steps in
  let transition ~time ~cause t =
    decr left;
    if !left = 0 then raise Enough;
    taken := (Option.get (Bounds.milliseconds time), Taken (cause, t)) :: !taken
  in
  let news ~time (s : World.vehicle_state) =
    taken := (Option.get (Bounds.milliseconds time), Heard (s.id, s.connected)) :: !taken in
  let whole () =
    Driver.run (module Platform) (Platform.create ~seed scenario) ~observer:{ Observer.nobody with transition; news }
      ~host:(Answering.host scenario) ~console:(Answering.console scenario) ~interruption:(fst (Lwt.wait ())) program
  in
  (match Lwt_main.run (whole ()) with Ended _ | Stuck _ | Spins _ -> () | exception Enough -> ());
  List.rev !taken

let follow options run =
  let next (r, found) = function
    | date, Taken (on, t) -> let r, more = Dated_run.transition r ~date ~on t in (r, found @ more)
    | date, Heard (v, connected) -> (Dated_run.heard r ~date v connected, found)
  in
  snd (List.fold_left next (Dated_run.start ~tolerance:0 options, []) run)

let is_within (w : Timed_analysis.window) date =
  date >= w.earliest - 1 && (match w.latest with At latest -> date <= latest + 1 | Unbounded -> true)

(* The dates of a run against the results for all runs. *)
let check_dates name (o : Timed_analysis.outcome) run =
  let ending : Configuration.ending -> Timed_system.ending option = function
    | Completed -> Some Completed
    | Halted _ -> Some Halted
    | Failed _ -> Some Failed
    | Interrupted -> None
  in
  let check_window what windows date =
    match windows with
    | Some w when is_within w date -> ()
    | Some (_ : Timed_analysis.window) -> Alcotest.failf "%s: %s at %d ms, which is not within its bounds" name what date
    | None -> Alcotest.failf "%s: %s, which no run does" name what
  in
  let of_task v (p : Core.platform_task) moment date =
    let task : Timed_analysis.task = { name = p.name; vehicle = v; site = p.task_site } in
    check_window (p.name ^ " on " ^ v) (Option.bind (List.assoc_opt task o.tasks) (List.assoc_opt moment)) date
  in
  let step allocation date (t : Transition.t) =
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
  let line allocation = function date, Taken (_, t) -> step allocation date t | _, Heard _ -> allocation in
  ignore (List.fold_left line Vehicle_map.empty run)

let limits = { Dolphin_checker.Limits.none with max_states = Some 2_000 }
let compared = ref 0

let check name ~seeds ~fleet source =
  let scenario =
    match Scenario.read ~file:name fleet with
    | Ok scenario -> scenario
    | Error _ -> Alcotest.fail "the fleet is wrong"
  in
  let program = Test_support.Pure_run.compile_exn ?place:scenario.plans_at source in
  let options : Clocked.options =
    { environment = Scenario_world.environment ~answers:[] ~faults:Dolphin_environment.Faults.none program scenario;
      program;
      world = Scenario_world.world scenario; durations = Durations.of_scenario scenario;
      dates = Dolphin_semantics.Dated_code.named program }
  in
  let o = Timed_analysis.run limits options in
  for seed = 1 to seeds do
    let run = run ~seed scenario program in
    (match follow options run with
     | [] -> ()
     | { pending; began; seen; _ } :: _ ->
       let what = match pending.task with Some p -> p.name | None -> "a timer" in
       Alcotest.failf "%s, seed %d: %s from %d to %d ms is outside of its bounds" name seed what began seen);
    if o.stopped = None then begin Test_support.Property.count compared; check_dates name o run end
  done

let check_example name () =
  let file ending = read_file (Filename.concat folder (name ^ ending)) in
  check name ~seeds ~fleet:(file ".fleet") (file ".dol")

(* {1 Links that come and go} *)

(* Vehicles that join, leave, and lose their links for longer or shorter than the connection timeout, at dates of all
   kinds; the order, the way and the end of tasks fall into these spans. *)
let fleets =
  let open QCheck2.Gen in
  let vehicle id =
    let* drops = list_size (int_bound 2) (pair (int_bound 60) (int_range 1 25)) in
    let* joins = oneof [ return 0; int_range 1 20 ] in
    let* leaves = oneof [ return None; map Option.some (int_range 21 70) ] in
    let drop (from, lasts) = Printf.sprintf "; drops %d.seconds, %d.seconds" from lasts in
    let leaves = Option.fold leaves ~none:"" ~some:(Printf.sprintf "; leaves %d.seconds") in
    let joins = if joins > 0 then Printf.sprintf "; joins %d.seconds" joins else "" in
    return
      (Printf.sprintf "vehicle '%s', { type 'UUV'%s%s%s }\n" id joins leaves (String.concat "" (List.map drop drops)))
  in
  let* vehicles = flatten_l (List.map vehicle [ "a"; "b" ]) in
  let* least = int_bound 15 in
  let* most = int_range least 20 in
  return
    (String.concat "" vehicles
     ^ Printf.sprintf "plan 'p', { duration %d, %d }\nplan 'q', { duration 4, 9; mayFail 0.3 }\nplan 'r', { fails }\n"
       least most)

let linked_program =
  let open QCheck2.Gen in
  let task = oneofl [ "task('p')[v]"; "task('q')[v]"; "task('p')[v] >> task('q')[v]"; "idle(7) >> task('p')[v]";
                      "watch task('q')[v] onError { retry() }"; "watch task('r')[v] onError { task('p') }";
                      "task('p')[v] during 12" ] in
  let execute = map (Printf.sprintf "if (v) execute watch (%s) onError { ignore() }\n") task in
  let pick =
    oneofl [ "v = pick { type 'UUV'; timeout 15 } else { null }\n"; "v = pick { id 'b'; timeout 30 } else { null }\n" ] in
  let part = frequency [ (3, execute); (1, pick); (1, return "pause 5\n"); (1, return "setConnectionTimeout 12\n") ] in
  map (fun parts -> "setConnectionTimeout 8\nv = pick { type 'UUV'; timeout 40 } else { null }\n" ^ String.concat "" parts)
    (list_size (int_range 1 4) part)

let test_links () =
  let before = !compared in
  let within (fleet, source) = check "random" ~seeds:3 ~fleet source; true in
  let print (fleet, source) = fleet ^ source in
  let test = QCheck2.Test.make ~count:programs ~print ~name:"runs lie within" QCheck2.Gen.(pair fleets linked_program) within in
  Test_support.Property.on_each_seed ~usual:20_261_125 ~programs test;
  Printf.printf "%d of %d runs compared\n" (!compared - before) (3 * programs);
  Alcotest.(check bool) "most" true (!compared - before > 2 * programs)

(* The task is over after 10 s, unheard until 45 s; the events of that time do not concern it. *)
let test_silence () =
  check "a link that is back" ~seeds:1
    ~fleet:"vehicle 'a', { type 'UUV'; drops 5.seconds, 40.seconds }\nplan 'p', { duration 10 }\n"
    "v = pick { id 'a' }\nsetConnectionTimeout v, 60\nexecute task('p')[v] | (idle(30) >> action { message 'x' })\n"

(* {1 Ways that are cut} *)

(* Plans with ways, one after the other, of which some are stopped on the way, or fail there: where a vehicle is then
   follows from where it was. Its next plan begins there, comes home, or is the rest of one before. *)
let ways_fleet =
  let open QCheck2.Gen in
  let degrees = map (fun n -> float_of_int n *. 1e-4) (int_range (-40) 40) in
  let vehicle kind id =
    let* north = degrees and* east = degrees and* speed = oneofl [ ""; "; speed 1"; "; speed 3.5" ] in
    return
      (Printf.sprintf "vehicle '%s', { type '%s'; at %.4f, %.4f%s }\n" id kind (41.185 +. north) (-8.706 +. east) speed)
  in
  let* a = vehicle "UUV" "a" and* b = vehicle "UAV" "b" and* fails = oneofl [ ""; "plan 'y', { mayFail 0.5 }\n" ] in
  return (a ^ b ^ fails)

let ways_program =
  let open QCheck2.Gen in
  let place = map2 (fun n e -> Printf.sprintf "location(%.4f, %.4f)" (41.185 +. (float_of_int n *. 1e-4))
                       (-8.706 +. (float_of_int e *. 1e-4))) (int_range (-40) 40) (int_range (-40) 40) in
  let places = list_size (int_range 1 3) place in
  let speed = oneofl [ ""; "speed 1.5, Speed.Units.METERS_PS; " ] in
  let plan name =
    let* places = places and* speed = speed and* last = oneofl [ ""; "; skeeping duration: 20.seconds"; "; move 50, 0; goTo()" ] in
    let go p = Printf.sprintf "locate %s; goTo()" p in
    return (Printf.sprintf "imcPlan { planName '%s'; %s%s%s }" name speed (String.concat "; " (List.map go places)) last)
  in
  let mission name =
    let* places = places and* last = oneofl [ ""; "; returnHome()"; "; returnHomeAndLand()"; "; move north: 80, east: 0" ] in
    let go p = "goPos " ^ p in
    return (Printf.sprintf "mission { name '%s'; takeOff 20; %s%s }" name (String.concat "; " (List.map go places)) last)
  in
  let* x = plan "x" and* y = plan "y" and* m = mission "m" and* n = mission "n" in
  let task v plans =
    let* p = oneofl (plans @ List.map (fun p -> Printf.sprintf "{ %s.rest(%s) }" p v) plans) in
    let* seconds = int_range 0 300 in
    let whole = Printf.sprintf "%s[%s]" p v in
    let handled = Printf.sprintf "watch %s onError { ignore() }" whole in
    oneofl [ handled; handled; Printf.sprintf "(%s) during %d" handled seconds;
             Printf.sprintf "(%s) until { consume cut: %d }" handled (seconds mod 3) ]
  in
  let sequence v plans =
    map (fun ts -> String.concat " >> " (List.map (Printf.sprintf "(%s)") ts)) (list_size (int_range 2 5) (task v plans)) in
  let* a = sequence "va" [ "x"; "y" ] and* b = sequence "vb" [ "m"; "n" ] in
  let* cuts = flatten_l (List.init 3 (fun i -> map (fun d -> Printf.sprintf "(idle(%d) >> action { post cut: %d })" d i) (int_range 1 400))) in
  return
    (Printf.sprintf "va = pick { id 'a' }\nvb = pick { id 'b' }\nx = %s\ny = %s\nm = %s\nn = %s\n\
                     execute (%s) | (%s) | %s\n" x y m n a b (String.concat " | " cuts))

let test_ways () =
  let before = !compared in
  let within (fleet, source) = check "random" ~seeds:3 ~fleet source; true in
  let print (fleet, source) = fleet ^ source in
  let programs = programs / 4 in
  let test = QCheck2.Test.make ~count:programs ~print ~name:"runs lie within" QCheck2.Gen.(pair ways_fleet ways_program) within in
  Test_support.Property.on_each_seed ~usual:20_261_128 ~programs test;
  Printf.printf "%d of %d runs compared\n" (!compared - before) (3 * programs);
  Alcotest.(check bool) "most" true (!compared - before > 2 * programs)

(* A plan that takes longer than in the fleet, or shorter, is found. *)
let test_findings () =
  let fleet duration =
    Result.get_ok
      (Scenario.read ~file:"f" ("vehicle 'a', { type 'UUV' }\nplan 'p', { duration " ^ duration ^ " }\n")) in
  let program = Test_support.Pure_run.compile_exn "va = pick { id 'a' }\nexecute task('p')[va] >> idle(5)\n" in
  let options scenario : Clocked.options =
    { environment = Scenario_world.environment ~answers:[] ~faults:Dolphin_environment.Faults.none program scenario;
      program; world = Scenario_world.world scenario; durations = Durations.of_scenario scenario;
      dates = Dolphin_semantics.Dated_code.named program } in
  let run = run ~seed:1 (fleet "50, 60") program in
  let found duration = List.map (fun (f : Dated_run.finding) -> f.too_early) (follow (options (fleet duration)) run) in
  Alcotest.(check (list bool)) "as it is" [] (found "50, 60");
  Alcotest.(check (list bool)) "too late" [ false ] (found "20, 30");
  Alcotest.(check (list bool)) "too early" [ true ] (found "100, 110");
  let put_off (date, line) =
    ((match line with Taken (Some (Transition.Timer_expired _), _) -> date + 9_000 | _ -> date), line) in
  let late = List.map put_off run in
  Alcotest.(check (list bool)) "a timer" [ false ]
    (List.map (fun (f : Dated_run.finding) -> f.too_early) (follow (options (fleet "50, 60")) late))

let () =
  let case name = Alcotest.test_case name `Quick (check_example name) in
  Alcotest.run "recorded"
    [ ("examples", List.map case (Test_support.Examples.with_fleets ()));
      ("links",
       [ Alcotest.test_case "that come and go" `Quick test_links;
         Alcotest.test_case "that are back after the end" `Quick test_silence ]);
      ("ways", [ Alcotest.test_case "that are cut" `Quick test_ways ]);
      ("findings", [ Alcotest.test_case "too early and too late" `Quick test_findings;
                     Alcotest.test_case "many were compared" `Quick (fun () ->
                         Alcotest.(check bool) "most" true (!compared > 20 * seeds)) ]) ]
