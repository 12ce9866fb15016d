(* Dates that are known without a search: sums and maxima for tasks in series and side by side, and missions worked out
   by hand. *)

open Dolphin_time
module Generate = Test_support.Generate
module Scenario = Dolphin_scenario.Scenario
module Environment = Dolphin_environment.Environment
module Faults = Dolphin_environment.Faults
module Scenario_world = Dolphin_environment.Scenario_world

let read_file path =
  let channel = open_in_bin path in
  let text = really_input_string channel (in_channel_length channel) in
  close_in channel;
  text

let fleet text =
  match Scenario.read ~file:"test.fleet" text with
  | Ok scenario -> scenario
  | Error _ -> Alcotest.fail "the fleet is wrong"

let outcome ?reduction ?(limits = Dolphin_checker.Limits.none) ?(faults = "") program scenario =
  let faults = if faults = "" then Faults.none else Result.get_ok (Faults.of_string faults) in
  let program = Test_support.Pure_run.compile_exn ?place:scenario.Scenario.plans_at program in
  Timed_analysis.run ?reduction ~vehicles:scenario.vehicles limits
    { environment = Scenario_world.environment ~answers:[] ~faults program scenario; program;
      world = Scenario_world.world scenario; durations = Durations.of_scenario scenario;
      dates = Dolphin_semantics.Dated_code.named program }

let seconds (w : Timed_analysis.window) =
  (float w.earliest /. 1000., match w.latest with At n -> float n /. 1000. | Unbounded -> infinity)

let pp_window ppf (a, b) = Format.fprintf ppf "%g to %g" a b
let window = Alcotest.testable pp_window ( = )

let ends ?(ending = Timed_system.Completed) (o : Timed_analysis.outcome) =
  match List.assoc_opt ending o.endings with Some w -> seconds w | None -> Alcotest.fail "no run ends so"

let of_task (o : Timed_analysis.outcome) name moment =
  let is_it ((t : Timed_analysis.task), _) = t.name = name in
  match List.find_opt is_it o.tasks with
  | Some (_, moments) -> seconds (List.assoc moment moments)
  | None -> Alcotest.failf "no task %s" name

(* {1 In series and side by side} *)

type tree = Plan of string * int * int | Idle of int | Then of tree * tree | Beside of tree * tree

let rec text = function
  | Plan (v, least, most) -> Printf.sprintf "task('p_%d_%d')[%s]" least most v
  | Idle n -> Printf.sprintf "idle(%d)" n
  | Then (a, b) -> Printf.sprintf "(%s >> %s)" (text a) (text b)
  | Beside (a, b) -> Printf.sprintf "(%s | %s)" (text a) (text b)

let rec bounds = function
  | Plan (_, least, most) -> (float least, float most)
  | Idle n -> (float n, float n)
  | Then (a, b) -> let (l, m), (l', m') = (bounds a, bounds b) in (l +. l', m +. m')
  | Beside (a, b) -> let (l, m), (l', m') = (bounds a, bounds b) in (Float.max l l', Float.max m m')

let rec plans = function
  | Plan (_, least, most) -> [ (least, most) ]
  | Idle _ -> []
  | Then (a, b) | Beside (a, b) -> plans a @ plans b

let tree =
  let open QCheck2.Gen in
  let leaf vs =
    let plan v = map2 (fun least more -> Plan (v, least, least + more)) (int_range 0 20) (int_range 0 20) in
    match vs with [] -> map (fun n -> Idle n) (int_range 0 20) | v :: _ -> plan v
  in
  let rec grow depth vs =
    if depth = 0 then leaf vs
    else
      let less = grow (depth - 1) in
      let beside = match vs with
        | v :: rest -> map2 (fun a b -> Beside (a, b)) (less [ v ]) (less rest)
        | [] -> map2 (fun a b -> Beside (a, b)) (less []) (less [])
      in
      oneof [ leaf vs; map2 (fun a b -> Then (a, b)) (less vs) (less vs); beside ]
  in
  grow 3 [ "a"; "b"; "c" ]

let agrees tree =
  let pick v = Printf.sprintf "%s = pick { id '%s' }\n" v v in
  let vehicles = String.concat "" (List.map pick [ "a"; "b"; "c" ]) in
  let vehicle v = Printf.sprintf "vehicle '%s', { type 'UUV' }\n" v in
  let plan (least, most) = Printf.sprintf "plan 'p_%d_%d', { duration %d, %d }\n" least most least most in
  let fleet_text =
    String.concat "" (List.map vehicle [ "a"; "b"; "c" ] @ List.map plan (List.sort_uniq compare (plans tree))) in
  let o = outcome (vehicles ^ "execute " ^ text tree ^ "\n") (fleet fleet_text) in
  ends o = bounds tree && o.endless = None

(* {1 Missions by hand} *)

let example name =
  let file ending = read_file (Filename.concat "../../examples" (name ^ ending)) in
  (file ".dol", fleet (file ".fleet"))

(* Each UUV surveys for 4 to 7 minutes, goes to the APDL and keeps station there for 10 minutes. The plane meets each
   for 40 to 80 seconds once it is ready, one after the other: the first survey is over at 4:00 at the earliest, so a
   visit begins then and ends at 4:40 at the earliest. At the latest all are ready at 7:00: the third visit begins at
   7:00 + 2 * 1:20 = 9:40 and ends at 11:00. All is over when the last UUV has kept station, for a UUV has at least 10
   minutes to go when it is ready, and the plane needs 4 at most. The UUV that has the longest way, noptilus-3, is the
   last one at the latest and, as all need 4 minutes at least, at the earliest. *)
let test_rendezvous () =
  let program, scenario = example "rendezvous" in
  let o = outcome program scenario in
  let way id =
    let v = List.find (fun (v : Scenario.vehicle) -> v.id = id) scenario.vehicles in
    Dolphin_geo.Wgs84.distance v.position Dolphin_geo.Place.apdl /. v.speed
  in
  let longest = List.fold_left (fun n id -> Float.max n (way id)) 0. [ "noptilus-1"; "noptilus-2"; "noptilus-3" ] in
  let down x = Float.floor (x *. 1000.) /. 1000. and up x = Float.ceil (x *. 1000.) /. 1000. in
  let earliest = 240. +. 600. +. down (0.9 *. longest) and latest = 420. +. 600. +. up (1.1 *. longest) in
  Alcotest.check window "completed" (earliest, latest) (ends o);
  let check_run what run date =
    let run = match run with Some (run : Timed_analysis.run) -> run | None -> Alcotest.fail (what ^ " is missing") in
    let ms = Option.get (Bounds.milliseconds date) in
    Alcotest.(check int) (what ^ " ends then") ms (List.fold_left max 0 run.dates);
    Alcotest.(check bool) (what ^ " goes forward") true (List.sort compare run.dates = run.dates);
    List.fold_left (fun n (l : Schedule.link) -> n + l.lasts) 0 run.chain
  in
  let sum = check_run "the last run" o.last latest in
  Alcotest.(check (option int)) "durations add up" (Bounds.milliseconds latest) (Some sum);
  ignore (check_run "the first run" o.first earliest);
  Alcotest.check window "a visit starts" (240., 580.) (of_task o "rv2" Starts);
  Alcotest.check window "a visit ends" (280., 660.) (of_task o "rv2" Ends);
  Alcotest.check window "a survey ends" (240., 420.) (of_task o "survey1" Ends)

let two = "vehicle 'a', { type 'UUV' }\nvehicle 'b', { type 'UUV' }\n"
let both = "va = pick { id 'a' }\nvb = pick { id 'b' }\n"

(* The survey of 15 to 19 minutes in a window of 10: a run meets the limit and another handles it, always at 10:00. *)
let test_within () =
  let o = outcome (both ^ "execute task('survey')[va] within 10.min\n")
      (fleet (two ^ "plan 'survey', { duration 8.min, 19.min }")) in
  Alcotest.check window "in time" (480., 600.) (ends o);
  Alcotest.check window "too late" (600., 600.) (ends ~ending:Failed o);
  Alcotest.check window "stopped" (600., 600.) (of_task o "survey" Stopped);
  let missed (o : Timed_analysis.outcome) =
    List.map (fun (_, missed) -> Option.map (fun (w, _) -> seconds w) missed) o.deadlines in
  let windows = Alcotest.(list (option window)) in
  Alcotest.check windows "missed" [ Some (600., 600.) ] (missed o);
  let two_of_them = "execute (task('survey')[va] within 19.min) >> (task('survey')[vb] within 10.min)\n" in
  let o = outcome (both ^ two_of_them) (fleet (two ^ "plan 'survey', { duration 8.min, 19.min }")) in
  Alcotest.check windows "the second is missed" [ Some (1140., 1140.); Some (1080., 1740.) ] (missed o);
  let o = outcome (both ^ "execute task('survey')[va] within 20.min\n")
      (fleet (two ^ "plan 'survey', { duration 8.min, 19.min }")) in
  Alcotest.check windows "kept" [ None ] (missed o)

(* A race: the first one ends the other one. *)
let test_until () =
  let race = "task('slow')[va] | task('quick')[vb] >> action { post done: 1 }" in
  let o = outcome (both ^ "execute until { poll done: 1 } run " ^ race ^ "\n")
      (fleet (two ^ "plan 'slow', { duration 5, 9 }\nplan 'quick', { duration 3, 7 }")) in
  Alcotest.check window "over" (3., 7.) (ends o);
  Alcotest.check window "slow ends" (5., 7.) (of_task o "slow" Ends);
  Alcotest.check window "slow is stopped" (3., 7.) (of_task o "slow" Stopped)

(* A plan on a silent link fails 60 s after the link went, which is at its latest end at the latest; the program
   makes that 10 s. *)
let test_faults () =
  let program = both ^ "execute task('p')[va]\n" and scenario = fleet (two ^ "plan 'p', { duration 5, 9 }") in
  Alcotest.check window "a failure" (0., 9.) (ends ~ending:Failed (outcome ~faults:"fail" program scenario));
  Alcotest.check window "a loss" (60., 69.) (ends ~ending:Failed (outcome ~faults:"loss" program scenario));
  let told = both ^ "setConnectionTimeout va, 10\nexecute task('p')[va]\n" in
  Alcotest.check window "a loss, told" (10., 19.) (ends ~ending:Failed (outcome ~faults:"loss" told scenario));
  Alcotest.check window "others complete" (5., 9.) (ends (outcome ~faults:"fail,loss" told scenario))

let is_endless (o : Timed_analysis.outcome) = match o.endless with
  | Some (_, `Cycle) -> "a cycle" | Some (_, `In_no_time) -> "a cycle in no time" | Some (_, `Stuck) -> "stuck"
  | None -> "all end"

let test_endless () =
  let scenario = fleet (two ^ "plan 'p', { duration 5, 9 }") in
  let check name expected program =
    Alcotest.(check string) name expected (is_endless (outcome (both ^ program) scenario)) in
  check "rounds" "a cycle" "execute repeat task('p')[va]\n";
  check "rounds until" "a cycle" "execute repeat task('p')[va] until { poll x: 1 }\n";
  check "rounds of no time" "a cycle in no time" "execute repeat idle(0) until { poll x: 1 }\n";
  check "a loop of the script" "a cycle" "while (true) { pause 1 }\n";
  check "nobody posts" "stuck" "execute waitFor { consume x: 1 } then task('p')[va]\n";
  check "rounds for a while" "all end" "execute (repeat task('p')[va]) during 60\n";
  check "counted rounds" "all end" "execute repeat 5, task('p')[va]\n";
  let timed program = ends (outcome (both ^ program) scenario) in
  Alcotest.check window "rounds for a while" (60., 60.) (timed "execute (repeat task('p')[va]) during 60\n");
  Alcotest.check window "counted rounds" (25., 45.) (timed "execute repeat 5, task('p')[va]\n");
  let perhaps = "oneOf {\n when { true } then action { post x: 1 }\n when { true } then idle 0\n }" in
  let program = both ^ "execute repeat (task('p')[va] >> " ^ perhaps ^ ") until { poll x: 1 }\n" in
  Alcotest.check window "rounds until somebody likes" (5., infinity) (ends (outcome program scenario));
  check "rounds until somebody likes" "a cycle"
    ("execute repeat (task('p')[va] >> " ^ perhaps ^ ") until { poll x: 1 }\n")

(* The duration of 'q' is unknown: later events have no latest time, parallel ones have. *)
let test_unknown () =
  let program = both ^ "execute task('q')[va] >> task('p')[va] | task('p')[vb]\n" in
  let o = outcome program (fleet (two ^ "plan 'p', { duration 5, 9 }")) in
  Alcotest.check window "completed" (5., infinity) (ends o);
  Alcotest.(check int) "one is unknown" 1 (List.length o.unknown);
  Alcotest.(check bool) "inconclusive" true (Timed_analysis.verdict o = Inconclusive);
  Alcotest.(check bool) "no deadline can be told" true (Timed_analysis.verdict ~deadline:100_000 o = Inconclusive)

let test_deadline () =
  let o = outcome (both ^ "execute task('p')[va]\n") (fleet (two ^ "plan 'p', { duration 5, 9 }")) in
  let verdict deadline = Timed_analysis.verdict ~deadline o in
  Alcotest.(check bool) "held" true (verdict 9_000 = Holds);
  Alcotest.(check bool) "broken by a millisecond" true (verdict 8_999 = Violated)

(* The limits are looked at before the steps of the initial state are known, of which each input is one. *)
let test_interrupted () =
  let inputs = String.concat "" (List.init 100 (Printf.sprintf "input 'n', %d\n")) in
  let asked = ref 0 in
  let interrupted () = incr asked; true in
  let limits = { Dolphin_checker.Limits.none with interrupted } in
  let o = outcome ~limits "input 'n'\nconsume n: _\n" (fleet inputs) in
  Alcotest.(check int) "states" 0 o.states;
  Alcotest.(check bool) "interrupted" true (o.stopped = Some Interruption);
  Alcotest.(check bool) "asked a few times" true (!asked > 0 && !asked < 10)

(* The long way takes 9, the other one 2 + 3 + 1: each of its tasks may take 3 more. A task that is cut off when the
   other is done may take any time; a task that runs twice, for 3 at most, may take half of the other 3 more. *)
let test_slack () =
  let slacks program =
    let program = Test_support.Pure_run.compile_exn (both ^ program) in
    let scenario = fleet (two ^ "plan 'p', { duration 5, 9 }\nplan 'q', { duration 2 }\nplan 'r', { duration 1, 3 }") in
    let options : Clocked.options =
      { environment = Scenario_world.environment ~answers:[] ~faults:Faults.none program scenario; program;
        world = Scenario_world.world scenario; durations = Durations.of_scenario scenario;
        dates = Dolphin_semantics.Dated_code.named program } in
    let limits = Dolphin_checker.Limits.none in
    let outcome = Timed_analysis.run limits options in
    let { Timed_analysis.known = found; _ } = Timed_analysis.slacks limits options outcome in
    let text : Slack.t -> string = function Any -> "any" | By ms -> string_of_int ms in
    List.sort compare (List.map (fun ((t : Timed_analysis.task), s) -> (t.vehicle ^ " " ^ t.name, text s)) found)
  in
  let check what expected program =
    Alcotest.(check (list (pair string string))) what expected (slacks ("execute " ^ program ^ "\n")) in
  check "two ways" [ ("a p", "0"); ("b q", "3000"); ("b r", "3000") ]
    "task('p')[va] | task('q')[vb] >> task('r')[vb] >> idle(1)";
  check "whatever is cut" [ ("a p", "any"); ("b r", "0") ]
    "until { poll done: 1 } run task('p')[va] | task('r')[vb] >> action { post done: 1 }";
  check "twice" [ ("a p", "0"); ("b r", "1500") ] "task('p')[va] | repeat 2, task('r')[vb]";
  check "without end" [] "repeat task('p')[va]"

(* Shares of an hour under way, 60 % with a, and a quarter of that at rest, but for b, which is charged then.
   a: 10 min of p, 20 at rest, 10 of p take 10 + 5 + 10 %. b: 10 min of p take 10 %, wherever they are.
   With a race, p is cut off after 5 min; with rounds, there are three. *)
let test_batteries () =
  let scenario =
    fleet
      "vehicle 'a', { type 'UUV'; battery 50.percent; drain 60.percent }\n\
       vehicle 'b', { type 'UUV'; drain 60.percent; charge 600.percent }\n\
       plan 'p', { duration 5.min, 10.min }\nplan 'q', { duration 5.min }\n\
       plan 'dock', { duration 5.min, 8.min; charges 120.percent }" in
  let found ?(faults = "") program =
    let faults = if faults = "" then Faults.none else Result.get_ok (Faults.of_string faults) in
    let program = Test_support.Pure_run.compile_exn (both ^ program) in
    Timed_analysis.run ~vehicles:scenario.vehicles Dolphin_checker.Limits.none
      { environment = Scenario_world.environment ~answers:[] ~faults program scenario; program;
        world = Scenario_world.world scenario; durations = Durations.of_scenario scenario;
        dates = Dolphin_semantics.Dated_code.named program }
  in
  let tenths x = Float.to_int (Float.round (1000. *. x)) in
  let check ?faults what expected program =
    let o = found ?faults ("execute " ^ program ^ "\n") in
    let left (b : Timed_analysis.battery) =
      (b.vehicle, tenths b.least, Option.fold b.lowest ~none:(-1) ~some:(fun (x, _) -> tenths x)) in
    Alcotest.(check (list (triple string int int))) what expected (List.map left o.batteries);
    o
  in
  let ignored = List.iter ignore in
  ignored
    [ check "there and back" [ ("a", 250, 250) ] "task('p')[va] >> idle(20.min) >> task('p')[va]";
      check "side by side" [ ("a", 375, 375); ("b", 900, 900) ] "task('p')[va] | task('p')[vb] >> idle(10.min)";
      check "a race" [ ("a", 450, 450); ("b", 950, 950) ]
        "until { poll done: 1 } run task('p')[va] | task('q')[vb] >> action { post done: 1 }";
      check "rounds" [ ("a", 200, 200) ] "repeat 3, task('p')[va]";
      check "a failure" ~faults:"fail=1" [ ("a", 200, 200) ] "repeat 3, task('p')[va]";
      check "charged again" [ ("b", 900, 900) ] "repeat 3, (task('p')[vb] >> idle(20.min))";
      check "hardly charged" [ ("b", 817, 817) ] "task('p')[vb] >> idle(10.seconds) >> task('p')[vb]";
      check "charged by a plan" [ ("a", 400, 400) ] "task('p')[va] >> task('dock')[va] >> task('p')[va]";
      check "charged by a plan to full" [ ("b", 900, 900) ] "repeat 3, (task('p')[vb] >> task('dock')[vb])";
      check "charged by a plan that is cut off" [ ("a", 318, 318) ]
        "task('p')[va] >> (task('dock')[va] during 54.seconds) >> task('p')[va]";
      check "looked at" [ ("a", 350, -1) ]
        "task('p')[va] >> action { if (battery(va) < 0.45) { halt 'low' } } >> task('p')[va]" ];
  let kept =
    found
      "def f(v) {\n b = battery(v)\n task('p')[v] >> action { if (b < 0.45) { halt 'low' } } >> task('p')[v]\n}\n\
       execute f(va)\n" in
  Alcotest.(check (list int)) "what was seen before" [ 300 ]
    (List.map (fun (b : Timed_analysis.battery) -> tenths b.least) kept.batteries);
  let verdict program =
    let o = found ("execute " ^ program ^ "\n") in
    (Timed_analysis.verdict o = Violated, Timed_analysis.verdict o = Inconclusive, Timed_analysis.shortfall o) in
  let verdicts = Alcotest.(check bool) in
  verdicts "enough" true (verdict "repeat 4, task('p')[va]" = (false, false, None));
  verdicts "not enough" true (verdict "repeat 5, task('p')[va]" = (true, false, Some Empty));
  verdicts "enough if charged" true (verdict "repeat 10, (task('p')[vb] >> idle(20.min))" = (false, false, None));
  verdicts "enough, as the program looks" true
    (verdict "until { battery(va) < 0.1 } run repeat 5, task('p')[va]" = (false, false, None));
  verdicts "not known, though the program looks" true
    (verdict "repeat 5, (task('p')[va] >> action { if (battery(va) < 0.01) { halt 'low' } })" = (false, true, Some Unknown));
  verdicts "enough if a plan charges" true
    (verdict "repeat 10, (task('p')[va] >> task('dock')[va])" = (false, false, None));
  verdicts "not enough, though a plan charges" true
    (verdict "repeat 10, (task('p')[va] >> task('p')[va] >> task('p')[va] >> task('dock')[va])"
     = (true, false, Some Empty));
  let o = found "execute repeat task('p')[va]\n" in
  Alcotest.(check int) "nothing is said of runs without end" 0 (List.length o.batteries)

(* The link of a goes after 1 min for 30. While an order waits for it a rests, and so it does once it is over. Under
   way it takes 1 % a minute, at rest a quarter of that: 1 min of rest and 30 min of waiting before 10 of p are 7.75
   + 10 %, and p from the start takes 10, with 21 at rest after it, until its end is heard. The program sees the
   earlier battery meanwhile: p goes on though it is to be cut off at 45 %. *)
let test_batteries_without_link () =
  let scenario =
    fleet
      "vehicle 'a', { type 'UUV'; battery 50.percent; drain 60.percent; drops 1.min, 30.min }\n\
       plan 'p', { duration 10.min }" in
  let check what expected program =
    let program =
      Test_support.Pure_run.compile_exn ("va = pick { id 'a' }\nsetConnectionTimeout va, 1.hour\n" ^ program) in
    let o =
      Timed_analysis.run ~vehicles:scenario.vehicles Dolphin_checker.Limits.none
        { environment = Scenario_world.environment ~answers:[] ~faults:Faults.none program scenario; program;
          world = Scenario_world.world scenario; durations = Durations.of_scenario scenario;
          dates = Dolphin_semantics.Dated_code.named program } in
    let hundredths share = Float.to_int (Float.round (10_000. *. share)) in
    let found (b : Timed_analysis.battery) =
      (hundredths b.least, Option.map (fun (left, _) -> hundredths left) b.lowest) in
    Alcotest.(check (list (pair int (option int)))) what [ expected ] (List.map found o.batteries)
  in
  check "an order that waits" (3225, Some 3225) "pause 1.min\npause 1\nexecute task('p')[va]\n";
  check "a task that is over" (3475, Some 3475) "execute task('p')[va]\n";
  check "what is not seen" (3475, None) "execute until { battery(va) < 0.45 } run task('p')[va]\n"

(* [count _] takes its whole time-out; a vehicle that comes late may come until then. *)
let test_picks () =
  let scenario = fleet two in
  Alcotest.check window "all" (30., 30.) (ends (outcome "vs = pick { count _; timeout 30 }\n" scenario));
  Alcotest.check window "one" (0., 0.) (ends (outcome "vs = pick { count 2; timeout 30 }\n" scenario));
  let late = outcome ~faults:"join" "vs = pick { count 2; timeout 30 }\n" scenario in
  Alcotest.check window "late" (0., 30.) (ends late);
  Alcotest.check window "missing" (30., 30.) (ends ~ending:Failed late)

(* 'b' joins after 90 s, 'c' after 100. A search for 'b' ends then, or has ended before by its time-out; a [pick] of
   all takes those that are there when its time is over. *)
let test_joins () =
  let vehicles = "vehicle 'a', { type 'UUV' }\nvehicle 'b', { type 'UUV'; joins 90 }\n" in
  let scenario = fleet (vehicles ^ "vehicle 'c', { type 'UUV'; joins 100 }\nplan 'p', { duration 5, 9 }") in
  let check ?ending what expected program =
    Alcotest.check window what expected (ends ?ending (outcome program scenario)) in
  check "the first that is there" (0., 0.) "v = pick { type 'UUV' }\n";
  check "waits for it" (90., 90.) "vs = pick { count 2; timeout 120 }\n";
  check "waits for the last" (100., 100.) "vs = pick { count 3; timeout 120 }\n";
  check ~ending:Failed "not so long" (89., 89.) "vs = pick { count 2; timeout 89 }\n";
  check ~ending:Failed "nobody knows it so early" (10., 10.) "v = pick { id 'b' }\n";
  check "it has come meanwhile" (99., 99.) "pause 99\nv = pick { id 'b' }\n";
  let all = "vs = pick { count _; timeout 95 }\nif (vs.size() == 2) { pause 1000 }\n" in
  check "those that are there then" (1095., 1095.) all;
  check "a recruit" (95., 99.) "execute recruit { id 'b' } then { v -> imcPlan('p') }\n";
  (* Tasks take 5 to 9 s each, so the second of two is there when ten are over, or not before the 90 s. *)
  check "while tasks execute" (90., 90.)
    "v = pick { id 'a' }\nexecute repeat 10, task('p')[v]\nvs = pick { id 'b'; timeout 100 }\n\
     if (vs.id() == 'c') { halt 'which' }\n";
  (* On the stroke it may have come, or not yet. *)
  let stroke = "vs = pick { count 2; timeout 90 }\n" in
  check "on the stroke" (90., 90.) stroke;
  check ~ending:Failed "on the stroke, too late" (90., 90.) stroke;
  (* Without searches after tasks, vehicles that join meanwhile make no states. *)
  let o = outcome (both ^ "execute task('p')[va] | task('p')[vb]\n") in
  let states fleet_text = (o (fleet fleet_text)).states in
  let two = two ^ "plan 'p', { duration 5, 9 }\n" in
  Alcotest.(check int) "as many states" (states two) (states (two ^ "vehicle 'd', { type 'UUV'; joins 3 }\n"))

(* A vehicle whose plan was stopped is somewhere on its way, and so the duration of its way back has bounds. *)
let test_places () =
  let goes = "p = imcPlan { planName 'go'\n goTo location: (location 41.19, -8.70)\n}\n" in
  let drifts = "q = mission { name 'on'; takeOff 20; move north: 100 }\n" in
  let unknown name n body =
    let o = outcome (both ^ goes ^ drifts ^ "execute " ^ body ^ "\n") (fleet (two ^ "plan 'x'")) in
    Alcotest.(check int) name n (List.length o.unknown)
  in
  unknown "from a known place" 0 "p[va] >> p[va]";
  unknown "stopped on the way" 0 "(p[va] during 1) >> p[va]";
  unknown "stopped again and again" 0 "(repeat 3, (p[va] during 1)) >> p[va]";
  unknown "stopped on a way from wherever it is" 1 "(q[va] during 1) >> p[va]";
  (* It goes there in 60 s or comes back in as many, and is between both places when it is stopped. *)
  let there_and_back =
    "here = location(41, -8)\n\
     def to(p) { imcPlan { planName 'p'\n speed 1, Speed.Units.METERS_PS\n locate p\n goTo() } }\n\
     execute (to(here.displace(60, 0))[v] during 30) >> to(here)[v]\n" in
  let text = "vehicle 'a', { type 'UUV'; at 41, -8 }\n" in
  Alcotest.check window "there and back" (30., 96.) (ends (outcome ("v = pick { id 'a' }\n" ^ there_and_back) (fleet text)));
  (* A mission that comes home leaves its vehicle where it began, be that a certain place or not. *)
  let home = "m = mission { takeOff 20; goPos location(41.001, -8); returnHomeAndLand() }\nexecute m[v] >> m[v]\n" in
  let o = outcome ("v = pick { id 'a' }\n" ^ home) (fleet "vehicle 'a', { type 'UAV'; at 41, -8 }\n") in
  Alcotest.(check int) "home again" 0 (List.length o.unknown)

(* The end of a task sets the date that code waits for. *)
let test_date_of_end () =
  let program = "due = 5\nexecute (idle(1) ensure { post n: 1; due = 9 }) >> condition { now() >= due }\n" in
  Alcotest.check window "the later date" (9., 9.) (ends (outcome program (fleet two)))

(* {1 Growth} *)

(* Vehicles that do one thing side by side, and meet. Zones that differ in the order of vehicles, or in the waits that
   began at one time, include each other: without that, ten vehicles have some three million states. *)
let test_meeting () =
  let meeting ~post n =
    let work i = Printf.sprintf "work(%d)" (i + 1) in
    let program =
      Printf.sprintf
        "vs = pick { count %d }\nmet = 0\n\
         def work(i) {\n\
        \  task('a') >> task('b') >> action { met++%s } >> condition { met == %d } >> task('c') >> task('a')\n\
         }\n\
         execute vs: %s\n" n post n (String.concat " | " (List.init n work)) in
    let vehicle i = Printf.sprintf "vehicle 'v%d', { type 'UUV'; at 41.18, -8.70 }\n" i in
    let plan name = Printf.sprintf "plan '%s', { duration 10, 20 }\n" name in
    outcome program (fleet (String.concat "" (List.init n vehicle @ List.map plan [ "a"; "b"; "c" ])))
  in
  let o = meeting ~post:"" 10 in
  Alcotest.check window "ends" (40., 80.) (ends o);
  Alcotest.check window "c begins" (20., 40.) (of_task o "c" Starts);
  Alcotest.(check bool) (Printf.sprintf "%d states" o.states) true (o.states < 1_500);
  let posting = meeting ~post:"; post here: i" 10 in
  Alcotest.(check int) "pairs that no code reads cost nothing" o.states posting.states

(* Sequences of tasks side by side, all of other durations, on which nothing depends but the end: each costs no more
   states than one task. *)
let test_sequences () =
  let n = 5 in
  let each separator f = String.concat separator (List.init n f) in
  let task i j = Printf.sprintf "task('p_%d_%d') >> action { message 'p_%d_%d' }" i j i j in
  let program =
    Printf.sprintf "vs = pick { count %d }\nexecute vs: %s\n" n
      (each " | " (fun i -> "(" ^ each " >> " (task i) ^ ")")) in
  let plan i j = Printf.sprintf "plan 'p_%d_%d', { duration %d, %d }\n" i j (10 + i + j) (20 + (2 * i) + (3 * j)) in
  let vehicles = each "" (Printf.sprintf "vehicle 'v%d', { type 'UUV' }\n") in
  let o = outcome program (fleet (vehicles ^ each "" (fun i -> each "" (plan i)))) in
  Alcotest.check window "ends" (80., 170.) (ends o);
  Alcotest.check window "a third task starts" (25., 51.) (of_task o "p_2_2" Starts);
  Alcotest.check window "a third task ends" (39., 81.) (of_task o "p_2_2" Ends);
  Alcotest.(check bool) (Printf.sprintf "%d states" o.states) true (o.states < 100)

(* Handlers that are never called cost nothing, whatever they would do; they count where plans may fail. *)
let test_handlers () =
  let each n separator f = String.concat separator (List.init n f) in
  let work n =
    let branch i = Printf.sprintf "work(vs[%d])" i in
    Printf.sprintf
      "vs = pick { count %d }\n\
       def work(v) { (watch (task('a') >> task('b') >> task('c')) onError { task('home')[v] })[v] }\n\
       execute watch (%s) onError { retry() }\n" n (each n " | " branch) in
  let plan name = Printf.sprintf "plan '%s', { duration 10, 20 }\n" name in
  let fleet n = fleet (each n "" (Printf.sprintf "vehicle 'v%d', { type 'UUV' }\n")
                       ^ String.concat "" (List.map plan [ "a"; "b"; "c"; "home" ])) in
  let o = outcome (work 6) (fleet 6) in
  Alcotest.check window "ends" (30., 60.) (ends o);
  Alcotest.(check bool) (Printf.sprintf "%d states" o.states) true (o.states < 200);
  let faulty = outcome ~faults:"fail=1" (work 2) (fleet 2) in
  Alcotest.check window "one comes home" (30., 80.) (ends faulty);
  let plain = outcome ~reduction:Nothing ~faults:"fail=1" (work 2) (fleet 2) in
  Alcotest.(check bool) "the same dates" true (faulty.endings = plain.endings)

(* The duration of a way depends on where the one before has ended, and its vehicle may go on from there later. *)
let test_sequence_of_ways () =
  let fleet =
    fleet
      "vehicle 'a', { type 'UUV'; at 41, -8 }\nvehicle 'b', { type 'UUV'; at 41, -8 }\nplan 'x', { duration 9, 30 }\n"
  in
  let program =
    "a = pick { id 'a' }\nb = pick { id 'b' }\nhere = location(41, -8)\n\
     def to(n) { imcPlan { planName 'to' + n\n speed 1, Speed.Units.METERS_PS\n locate here.displace(n, 0)\n goTo() } }\n\
     execute (to(60)[a] >> to(90)[a] >> to(30)[a]) | (task('x')[b] >> to(20)[b] >> idle(5) >> task('x')[b])\n\
     execute to(0)[a] | to(40)[b]\n" in
  let outcome reduction = outcome ~reduction program fleet in
  let plain = outcome Timed_analysis.Nothing in
  let check name reduction =
    let o = outcome reduction in
    let answers (o : Timed_analysis.outcome) =
      let batteries = List.map (fun (b : Timed_analysis.battery) -> (b.vehicle, b.least)) o.batteries in
      (List.sort compare o.tasks, o.endings, batteries) in
    Alcotest.(check bool) (name ^ ": the same dates and batteries") true (answers o = answers plain);
    Alcotest.(check bool) (name ^ ": in fewer states") true (o.states < plain.states)
  in
  Alcotest.check window "the second way" (27., 33.) (
    match of_task plain "to90" Starts, of_task plain "to90" Ends with (s, s'), (e, e') -> (e -. s, e' -. s'));
  check "sequences" Inert_ends;
  check "sequences and likeness" Inert_ends_and_canonical_states

(* 3 km at 10 m/s, and 10 m at 1 m/s: a rest in the slow part is gone to at 1 m/s, so it may take longer than the whole.
   10 percent more are granted for ways. *)
let test_rest () =
  let program =
    "v = pick { id 'v' }\nw = pick { id 'w' }\n\
     p = imcPlan {\n\
    \  planName 'p'\n\
    \  locate 41.185, -8.706\n\
    \  speed 10, Speed.Units.METERS_PS; goTo(); move 3000, 0; goTo()\n\
    \  speed 1, Speed.Units.METERS_PS; move 10, 0; goTo()\n\
     }\n\
     execute p[v] until { battery(v) < 0.5 }\nexecute p.rest(v)[w]\n"
  in
  let vehicle id = Printf.sprintf "vehicle '%s', { type 'UUV'; at 41.185, -8.706 }\n" id in
  let earliest, latest = ends (outcome program (fleet (vehicle "v" ^ vehicle "w"))) in
  Alcotest.(check (float 0.)) "nothing may be left" 0. earliest;
  Alcotest.(check (float 2.)) "all of it, slowly" ((1.1 *. 310.) +. (1.1 *. 3010.)) latest

let () =
  let case name f = Alcotest.test_case name `Quick f in
  Alcotest.run "missions"
    [ ("closed forms", [ Test_support.Property.case ~count:300 "in series and side by side" ~print:text tree agrees ]);
      ("by hand",
       [ case "the paper's mission" test_rendezvous; case "within" test_within; case "until" test_until;
         case "faults" test_faults; case "runs without end" test_endless; case "unknown durations" test_unknown;
         case "deadlines" test_deadline; case "slack" test_slack; case "batteries" test_batteries;
         case "batteries without a link" test_batteries_without_link; case "picks" test_picks; case "joins" test_joins;
         case "places" test_places; case "growth of a meeting" test_meeting; case "sequences" test_sequences;
         case "handlers" test_handlers;
         case "sequences of ways" test_sequence_of_ways;
         case "a date set by an end" test_date_of_end; case "interrupted at the start" test_interrupted;
         case "the rest of a plan" test_rest ]) ]
