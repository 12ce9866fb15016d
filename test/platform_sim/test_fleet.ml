open Dolphin_platform_sim
open Dolphin_geo
open Common
module Platform = Dolphin_runtime.Platform

let make ?(seed = 1) source = Fleet.create ~seed (scenario source)
let single ?(plans = "") settings = make (Printf.sprintf "vehicle 'a', { type 'UUV'; %s }\n%s" settings plans)

(* [until time f] is the events up to [time], in order, and the fleet then. *)
let until time f =
  let rec go reversed f =
    match Fleet.due f with
    | Some due when due <= time -> (
        match Fleet.step f with
        | Some (Some event, f) -> go ((Fleet.now f, event) :: reversed) f
        | Some (None, f) -> go reversed f
        | None -> List.rev reversed, f)
    | Some _ | None -> List.rev reversed, Fleet.advance f time
  in
  go [] f

let after time f = snd (until time f)
let line (time, event) = Printf.sprintf "%g %s" time (show event)
let is_news = function Platform.Vehicle _ -> false | Task_done _ | Task_failed _ | Timer _ | Input _ | Quiet -> true
let check name expected happened = Alcotest.(check (list string)) name expected (List.map line happened)
let news happened = List.filter (fun (_, event) -> is_news event) happened
let check_news name expected happened = check name expected (news happened)

let ninety = "plan 'p', { duration 90 }"
let position_of f = match Fleet.vehicles f with [ v ] -> v.position | _ -> Alcotest.fail "one vehicle"
let battery_of f = match Fleet.vehicles f with [ { battery = Some share; _ } ] -> share | _ -> Alcotest.fail "one vehicle"

(* {1 Coming and going} *)

let announcements () =
  let f =
    make "vehicle 'a', { type 'UUV' }; vehicle 'c', { type 'UUV'; joins 5 }; vehicle 'b', { type 'UAV'; leaves 9 }" in
  let happened, f = until 20. f in
  check "seen, joining and leaving" [ "0 a seen"; "0 b seen"; "5 c seen"; "9 b unseen" ] happened;
  Alcotest.(check bool) "nothing more" true (Fleet.due f = None);
  Alcotest.(check (list (pair string bool)))
    "as they are" [ ("a", true); ("c", true); ("b", false) ]
    (List.map (fun (v : Dolphin_semantics.World.vehicle_state) -> (v.id, v.connected)) (Fleet.vehicles f))

let unheard () =
  let f = after 1. (make "vehicle 'a', { type 'UUV'; joins 5 }") in
  Alcotest.(check int) "not yet heard of" 0 (List.length (Fleet.vehicles f))

(* {1 Tasks} *)

let by_name () =
  let f = after 1. (single ~plans:ninety "") in
  let f = Fleet.start "a" (task "p") f in
  Alcotest.(check (option string)) "running" (Some "p") (Fleet.running f "a");
  let happened, f = until 1000. f in
  check "seen where it ends, then done" [ "91 a seen"; "91 a done" ] happened;
  Alcotest.(check (option string)) "not running" None (Fleet.running f "a")

let durations_in_range =
  law "durations lie in the plan's range" QCheck2.Gen.(pair small_nat (int_bound 5)) ~print:QCheck2.Print.(pair int int)
    (fun (seed, before) ->
       let f = make ~seed "vehicle 'a', { type 'UUV' }\nplan 'p', { duration 3.min, 9.min }" in
       let rec repeat n f =
         let started = Fleet.now f in
         match news (fst (until infinity (Fleet.start "a" (task "p") f))) with
         | [ (time, Task_done "a") ] ->
           let lasted = time -. started in
           lasted >= 180. && lasted <= 540. && (n = 0 || repeat (n - 1) (after time (Fleet.start "a" (task "p") f)))
         | _ -> false
       in
       repeat before f)

let default_duration () =
  let f = Fleet.start "a" (task "unheard of") (after 0. (single "")) in
  match news (fst (until infinity f)) with
  | [ (time, Task_done "a") ] -> Alcotest.(check bool) "1 to 3 minutes" true (time >= 60. && time <= 180.)
  | happened -> check "done" [] happened

let failures () =
  let f = Fleet.start "a" (task "p") (after 0. (single ~plans:"plan 'p', { duration 90; fails }" "")) in
  (match news (fst (until infinity f)) with
   | [ (time, Task_failed ("a", "plan failed")) ] -> Alcotest.(check bool) "on the way" true (time < 90.)
   | happened -> check "failed" [] happened);
  let failed share =
    let source = Printf.sprintf "vehicle 'a', { type 'UUV'; drain 0 }\nplan 'p', { duration 1; mayFail %s }" share in
    let once seed =
      let f = Fleet.start "a" (task "p") (after 0. (make ~seed source)) in
      match news (fst (until infinity f)) with [ (_, Task_failed _) ] -> 1 | _ -> 0 in
    List.fold_left (fun sum seed -> sum + once seed) 0 (List.init 1000 Fun.id) in
  Alcotest.(check int) "never" 0 (failed "0");
  Alcotest.(check int) "always" 1000 (failed "1");
  Alcotest.(check bool) "about a tenth" true (abs (failed "" - 100) < 30);
  Alcotest.(check bool) "about half" true (abs (failed "50.percent" - 500) < 50)

let refusals () =
  let f = after 0. (single ~plans:"plan 'p', { only 'UAV' }\nplan 'q', { only 'a' }" "") in
  check_news "unknown" [ "0 a failed: unknown plan 'p'" ] (fst (until 500. (Fleet.start "a" (task "p") f)));
  Alcotest.(check int) "known" 1 (List.length (news (fst (until 500. (Fleet.start "a" (task "q") f)))));
  let plan = { (go_to [ Place.apdl ]) with vehicles = [ "b" ] } in
  check_news "of others" [ "0 a failed: plan 'route' is not for this vehicle" ]
    (fst (until 500. (Fleet.start "a" (task ~plan "route") f)))

let already_running () =
  let f = after 0. (single ~plans:"plan 'p', { duration 90 }\nplan 'q', { duration 20 }" "") in
  let f = Fleet.start "a" (task "q") (after 10. (Fleet.start "a" (task "p") f)) in
  check_news "failed" [ "10 a failed: ordered to run 'q' while it ran 'p'" ] (fst (until 500. f))

(* {1 Silent links} *)

let short_drop () =
  let f = Fleet.start "a" (task "p") (after 0. (single ~plans:ninety "drops 80, 50")) in
  check "told on return" [ "80 a unseen"; "130 a seen"; "130 a done" ] (fst (until 1000. f))

let drop_within_task () =
  let f = Fleet.start "a" (task "p") (after 0. (single ~plans:ninety "drops 20, 50")) in
  check "as if nothing had been" [ "20 a unseen"; "70 a seen"; "90 a seen"; "90 a done" ] (fst (until 1000. f))

let long_drop () =
  let f = Fleet.start "a" (task "p") (after 0. (single ~plans:ninety "drops 80, 61")) in
  check "lost" [ "80 a unseen"; "140 a failed: connection lost for 60 s"; "141 a seen" ] (fst (until 1000. f))

let just_in_time () =
  let f = Fleet.start "a" (task "p") (after 0. (single ~plans:ninety "drops 80, 60")) in
  check_news "not longer than the timeout" [ "140 a done" ] (fst (until 1000. f))

let leaving () =
  let f = Fleet.start "a" (task "p") (after 0. (single ~plans:ninety "leaves 80")) in
  check_news "lost" [ "140 a failed: connection lost for 60 s" ] (fst (until 1000. f))

let timeouts () =
  let f = after 0. (single "drops 20, 50") in
  let lost set = news (fst (until 60. (set (Fleet.start "a" (task "p") f)))) in
  check "own" [ "30 a failed: connection lost for 10 s" ] (lost (Fleet.set_connection_timeout (Some [ "a" ]) 10.));
  check "all" [ "40 a failed: connection lost for 20 s" ] (lost (Fleet.set_connection_timeout None 20.));
  check "not its own" [] (lost (Fleet.set_connection_timeout (Some [ "b" ]) 10.));
  let own_then_all f = Fleet.set_connection_timeout None 20. (Fleet.set_connection_timeout (Some [ "a" ]) 5. f) in
  check "all after own" [ "40 a failed: connection lost for 20 s" ] (lost own_then_all);
  let f = after 35. (Fleet.start "a" (task "p") f) in
  check "while silent" [ "35 a failed: connection lost for 10 s" ]
    (news (fst (until 60. (Fleet.set_connection_timeout None 10. f))));
  check "longer while silent" []
    (news (fst (until 60. (Fleet.set_connection_timeout None 45. f))))

let start_in_silence () =
  let start drops = fst (until 200. (Fleet.start "a" (task "p") (after 20. (single ~plans:ninety drops)))) in
  check "delivered on return" [ "60 a seen"; "150 a seen"; "150 a done" ] (start "drops 10, 50");
  check "lost" [ "80 a failed: connection lost for 60 s"; "110 a seen" ] (start "drops 10, 100")

let stranger () =
  let f = Fleet.start "x" (task "p") (after 5. (single "")) in
  check "never answers" [ "65 x failed: connection lost for 60 s" ] (fst (until 200. f));
  check "can be stopped" [] (fst (until 200. (Fleet.stop "x" f)))

(* {1 Stops} *)

let stops () =
  let f = Fleet.start "a" (task "p") (after 0. (single ~plans:ninety "")) in
  let stopped = Fleet.stop "a" (after 30. f) in
  check "seen where it stopped" [ "30 a seen" ] (fst (until 1000. stopped));
  Alcotest.(check (option string)) "not running" None (Fleet.running stopped "a");
  let again = Fleet.start "a" (task "p") stopped in
  check_news "started again" [ "120 a done" ] (fst (until 1000. again));
  check "of a free vehicle" [] (fst (until 1000. (Fleet.stop "a" (after 0. (single "")))))

(* Between the end, which determines the position, and its report. *)
let stop_before_report () =
  let rec to_end f =
    match Fleet.step f with
    | Some (Some (Vehicle _), f) -> f
    | Some (_, f) -> to_end f
    | None -> Alcotest.fail "the task ends"
  in
  let f = to_end (Fleet.start "a" (task "p") (after 0. (single ~plans:ninety ""))) in
  Alcotest.(check (float 0.)) "at the end" 90. (Fleet.now f);
  check "no report" [] (fst (until 1000. (Fleet.stop "a" f)))

let stop_in_silence () =
  let f = Fleet.start "a" (task "p") (after 0. (single ~plans:ninety "drops 80, 70")) in
  let f = Fleet.stop "a" (after 100. f) in
  check "neither end nor loss" [ "150 a seen" ] (fst (until 1000. f))

(* {1 Timers} *)

let timers () =
  let f = after 0. (single "") in
  let f = Fleet.set_timer 1 20. (Fleet.set_timer 2 10. (Fleet.set_timer 3 20. f)) in
  check "by time, then in order" [ "10 timer 2"; "20 timer 3"; "20 timer 1" ] (fst (until 100. f));
  check "cancelled" [ "10 timer 2"; "20 timer 1" ] (fst (until 100. (Fleet.cancel_timer 3 f)));
  check "set anew" [ "10 timer 2"; "20 timer 1"; "30 timer 3" ] (fst (until 100. (Fleet.set_timer 3 30. f)));
  check "at once" [ "0 timer 4" ] (fst (until 5. (Fleet.set_timer 4 (-1.) f)));
  check "never" [ "10 timer 2"; "20 timer 3"; "20 timer 1" ] (fst (until 100. (Fleet.set_timer 4 infinity f)));
  Alcotest.(check (float 0.)) "time stands still until then" 10. (Fleet.now (Fleet.advance f 100.))

let timers_in_order =
  law "timers come in order of time, then of setting" QCheck2.Gen.(list_size (int_range 1 50) (int_range 0 9))
    ~print:QCheck2.Print.(list int)
    (fun delays ->
       let f = after 0. (single "") in
       let set (n, f) delay = (n + 1, Fleet.set_timer n (float_of_int delay) f) in
       let _, f = List.fold_left set (0, f) delays in
       let by_delay (a, _) (b, _) = Int.compare a b in
       let expected = List.stable_sort by_delay (List.mapi (fun i delay -> (delay, i)) delays) in
       let expected_line (delay, i) = Printf.sprintf "%d timer %d" delay i in
       List.map expected_line expected = List.map line (fst (until 100. f)))

(* {1 Batteries} *)

let batteries () =
  let close = Alcotest.(check (float 1e-9)) in
  let f = after 0. (single ~plans:"plan 'p', { duration 30.min }" "battery 50.percent; drain 40.percent") in
  close "at rest, a quarter" 0.4 (battery_of (after 3600. f));
  close "at work" 0.3 (battery_of (after 1800. (Fleet.start "a" (task "p") f)));
  close "at work, then at rest" 0.25 (battery_of (after 3600. (Fleet.start "a" (task "p") f)));
  let f = after 0. (single "battery 50.percent; charge 50.percent") in
  close "charged" 0.75 (battery_of (after 1800. f));
  close "full" 1. (battery_of (after 7200. f));
  let at_charger north =
    after 0. (single (Printf.sprintf "at 41.1850, -8.7060; battery 50.percent; drain 40.percent; charge 50.percent; \
                                      charger %.4f, -8.7060, 30.m" (41.1850 +. north))) in
  close "at a charger" 0.75 (battery_of (after 1800. (at_charger 0.0002)));
  close "away from it" 0.45 (battery_of (after 1800. (at_charger 0.0004)));
  let there = Dolphin_geo.Wgs84.displace Place.apdl ~north:1_350. ~east:0. in
  let route p = task ~plan:(go_to ~speed:1.5 ~dwell:900. [ p ]) "route" in
  let f = after 0. (single "at Location.APDL; battery 80.percent; drain 40.percent; charge 50.percent; \
                            charger Location.APDL, 30.m") in
  let out = after 3600. (Fleet.start "a" (route there) f) in
  Alcotest.(check (float 1e-3)) "at work for half an hour, then at rest away from it" 0.55 (battery_of out);
  let back = after 7200. (Fleet.start "a" (route Place.apdl) out) in
  Alcotest.(check (float 1e-3)) "at work again, then at rest at it" 0.60 (battery_of back);
  let plans = "plan 'p', { duration 30.min; charges 120.percent }\nplan 'q', { duration 30.min; charges 0.percent }" in
  let f = after 0. (single ~plans "battery 20.percent; drain 40.percent") in
  close "charged by a plan" 0.5 (battery_of (after 900. (Fleet.start "a" (task "p") f)));
  close "charged by a plan, then at rest" 0.75 (battery_of (after 3600. (Fleet.start "a" (task "p") f)));
  close "charged by a plan until it is stopped" 0.3
    (battery_of (after 4200. (Fleet.stop "a" (after 600. (Fleet.start "a" (task "p") f)))));
  close "neither charged nor drained" 0.2 (battery_of (after 1800. (Fleet.start "a" (task "q") f)));
  let f = after 0. (single ~plans "battery 0.percent") in
  let happened, _ = until 10_000. (Fleet.start "a" (task "p") f) in
  check_news "an empty vehicle is charged" [ "1800 a done" ] happened

let battery_empty () =
  let f = Fleet.start "a" (task "p") (after 0. (single ~plans:ninety "battery 1.percent; drain 100.percent")) in
  let happened, f = until 1000. f in
  check_news "on the way" [ "36 a failed: battery empty" ] happened;
  Alcotest.(check (float 0.)) "empty" 0. (battery_of f);
  check_news "at once" [ "1000 a failed: battery empty" ] (fst (until 1000. (Fleet.start "a" (task "p") f)))

(* {1 Ways} *)

let start : Position.t = { latitude = 41.185; longitude = -8.7062; height = 0. }

let inline_plan () =
  let f = after 10. (single "speed 2; at 41.185, -8.7062") in
  let there = Wgs84.displace start ~north:300. ~east:400. in
  let arrives name expected plan =
    match news (fst (until 1e6 (Fleet.start "a" (task ~plan "route") f))) with
    | [ (time, Task_done "a") ] -> Alcotest.(check (float 1e-3)) name expected (time -. 10.)
    | happened -> check name [ "done" ] happened
  in
  arrives "distance by its speed" 250. (go_to [ there ]);
  arrives "distance by the plan's speed" 500. (go_to ~speed:1. [ there ]);
  arrives "there and back, then stays" 530. (go_to ~dwell:30. [ there; start ]);
  let f = after 135. (Fleet.start "a" (task ~plan:(go_to [ there ]) "route") f) in
  Alcotest.(check (float 0.01)) "half-way" 250. (Wgs84.distance start (position_of f));
  let f = after 1000. (Fleet.stop "a" f) in
  Alcotest.(check (float 0.01)) "stays where it was stopped" 250. (Wgs84.distance start (position_of f))

(* The position of a vehicle of each type after half a plan, and after it, that is to be at [z]. *)
let levels () =
  let there = Wgs84.displace start ~north:300. ~east:400. in
  let check kind before z expected =
    let settings = Printf.sprintf "type '%s'; speed 2; drain 0; at 41.185, -8.7062, %g" kind before in
    let f = after 0. (Fleet.create ~seed:0 (scenario (Printf.sprintf "vehicle 'a', { %s }" settings))) in
    let maneuver = { (List.hd (go_to [ there ]).maneuvers) with z } in
    let f = Fleet.start "a" (task ~plan:{ (go_to [ there ]) with maneuvers = [ maneuver ] } "route") f in
    let height time = (position_of (after time f)).height in
    Alcotest.(check (list (float 1e-6))) (kind ^ Printf.sprintf " %g" (fst z)) expected [ height 5.; height 250. ]
  in
  check "UUV" 0. (8., Depth) [ -2.5; -8. ];
  check "AUV" (-10.) (3., Depth) [ -7.5; -3. ];
  check "ROV" 0. (-5., Height) [ -2.5; -5. ];
  check "uuv" (-1.) (40., Height) [ 0.; 0. ];
  check "UUV" (-7.) (5., Altitude) [ -7.; -7. ];
  check "UUV" (-7.) (5., Unspecified) [ -7.; -7. ];
  check "UAV" 0. (60., Height) [ 15.; 60. ];
  check "UAV" 70. (60., Altitude) [ 60.; 60. ];
  check "UAV" 70. (2., Depth) [ 70.; 70. ];
  check "USV" 0. (2., Depth) [ 0.; 0. ];
  check "UGV" 12. (2., Height) [ 12.; 12. ];
  check "crawler" 0. (2., Depth) [ -2.; -2. ];
  check "crawler" 0. (2., Height) [ 2.; 2. ]

let endless_plan () =
  let f = after 0. (single "drain 0; speed 2; at 41.185, -8.7062") in
  let f = Fleet.start "a" (task ~plan:(go_to ~dwell:0. [ start ]) "route") f in
  Alcotest.(check bool) "no end" true (fst (until 1e9 f) = [] && Fleet.quiet f);
  Alcotest.(check (option string)) "runs" (Some "route") (Fleet.running (after 1e9 f) "a")

let circuit () =
  let f = after 0. (single ~plans:ninety "at 41.185, -8.7062; speed 1.5") in
  let f = Fleet.start "a" (task "p") f in
  let distance time = Wgs84.distance start (position_of (after time f)) in
  Alcotest.(check bool) "it moves" true (distance 45. > 40.);
  Alcotest.(check (float 1e-6)) "and comes back" 0. (distance 90.)

let place () =
  let run settings =
    let plans = Printf.sprintf "plan 'p', { %s }" settings in
    Fleet.start "a" (task "p") (after 0. (single ~plans "at 41.185, -8.7062; speed 2")) in
  let at = Wgs84.displace start ~north:200. ~east:0. in
  let place = Printf.sprintf "at %.12f, %.12f" at.latitude at.longitude in
  let check name expected f time =
    Alcotest.(check (float 0.01)) name expected (Wgs84.distance start (position_of (after time f))) in
  let f = run (place ^ "; duration 300") in
  check "on the way" 100. f 50.;
  check "there" 200. f 150.;
  check "on the way back" 100. f 250.;
  check "back" 0. f 300.;
  check "not enough time" 100. (run (place ^ "; duration 100")) 50.

(* {1 Telemetry} *)

let telemetry () =
  let f = make "vehicle 'a', { type 'UUV' }; vehicle 'b', { type 'UUV' }" in
  let f = Fleet.telemetry Awaited (Fleet.bind [ "a" ] (after 0. f)) in
  check "each second, of those that are bound" [ "1 a seen"; "2 a seen"; "3 a seen" ] (fst (until 3.5 f));
  let f = Fleet.telemetry Off (after 3.5 f) in
  check "off" [] (fst (until 10. f));
  let f = Fleet.telemetry Awaited (after 10. f) in
  check "on again" [ "10 a seen"; "11 a seen" ] (fst (until 11.5 f));
  check "released" [] (fst (until 20. (Fleet.release [ "a" ] f)))

let telemetry_ends () =
  let f = Fleet.telemetry Awaited (Fleet.bind [ "a" ] (after 0. (single "drain 0"))) in
  Alcotest.(check bool) "nothing changes" true (Fleet.quiet f);
  let f = Fleet.telemetry Awaited (Fleet.bind [ "a" ] (after 0. (single "drain 60.percent; battery 0.1.percent"))) in
  Alcotest.(check bool) "the battery does" false (Fleet.quiet f);
  let happened, f = until 1000. f in
  Alcotest.(check int) "until it is empty" 24 (List.length happened);
  Alcotest.(check bool) "then nothing" true (Fleet.quiet f);
  let f = Fleet.start "a" (task "p") (after 0. (single "drain 0")) in
  let f = Fleet.telemetry Awaited (Fleet.bind [ "a" ] f) in
  Alcotest.(check int) "under way, and at once how fast" 51 (List.length (fst (until 50. f)))

(* {1 Whole runs} *)

(* Each vehicle runs [n] tasks, one after the other: all that happens, in order. *)
let mission ?(n = 10) ~seed s =
  let rec go left reversed f =
    match Fleet.step f with
    | None -> List.rev reversed
    | Some (None, f) -> go left reversed f
    | Some (Some event, f) ->
      let reversed = (Fleet.now f, event) :: reversed in
      let again id =
        let todo = Option.value (List.assoc_opt id left) ~default:n in
        if todo = 0 then go left reversed f
        else go ((id, todo - 1) :: List.remove_assoc id left) reversed (Fleet.start id (task "survey") f) in
      match event with
      | Vehicle { connected = true; id; _ } when not (List.mem_assoc id left) -> again id
      | Task_done id | Task_failed (id, _) -> again id
      | Vehicle _ | Timer _ | Input _ | Quiet -> go left reversed f
  in
  go [] [] (Fleet.create ~seed s)

let busy =
  "vehicle 'a', { type 'UUV' }; vehicle 'b', { type 'UAV'; drops 100, 200 }; vehicle 'c', { type 'UUV'; joins 50 }\n\
   plan 'survey', { duration 1.min, 5.min; mayFail 30.percent }"

let reproducible () =
  let lines seed source = List.map line (mission ~seed (scenario source)) in
  Alcotest.(check (list string)) "same seed" (lines 7 busy) (lines 7 busy);
  Alcotest.(check bool) "other seed" false (lines 7 busy = lines 8 busy);
  let of_a lines = List.filter (fun line -> List.mem "a" (String.split_on_char ' ' line)) lines in
  Alcotest.(check (list string))
    "others do not matter" (of_a (lines 7 busy))
    (of_a (lines 7 "vehicle 'a', { type 'UUV' }\nplan 'survey', { duration 1.min, 5.min; mayFail 30.percent }"))

let draws_are_even () =
  let bins = Array.make 10 0 in
  for seed = 0 to 9 do
    for start = 0 to 999 do
      let share = Draw.share ~seed ~vehicle:"noptilus-1" ~start Length in
      let bin = int_of_float (share *. 10.) in
      bins.(bin) <- bins.(bin) + 1
    done
  done;
  Array.iter (fun n -> Alcotest.(check bool) "about a tenth" true (abs (n - 1000) < 120)) bins;
  (* So that runs are the same elsewhere and in later versions. *)
  Alcotest.(check (float 1e-15)) "a draw" 0.10672919215905563 (Draw.share ~seed:1 ~vehicle:"a" ~start:0 Length)

let () =
  Alcotest.run "fleet"
    [ ("coming and going", [ case "announcements" announcements; case "unheard of" unheard ]);
      ( "tasks",
        [ case "by name" by_name; durations_in_range; case "default duration" default_duration;
          case "failures" failures;
          case "refusals" refusals; case "already running" already_running ] );
      ( "silence",
        [ case "shorter than the timeout, at the end" short_drop;
          case "shorter than the timeout, within" drop_within_task;
          case "longer than the timeout" long_drop; case "as long as the timeout" just_in_time; case "leaving" leaving;
          case "timeouts" timeouts; case "start" start_in_silence; case "unknown vehicle" stranger ] );
      ( "stops",
        [ case "stop" stops; case "before the report" stop_before_report; case "in silence" stop_in_silence ] );
      ("timers", [ case "timers" timers; timers_in_order ]);
      ("batteries", [ case "level" batteries; case "empty" battery_empty ]);
      ( "ways",
        [ case "inline plan" inline_plan; case "heights by type" levels; case "plan without end" endless_plan; case "circuit" circuit;
          case "there and back" place ] );
      ("telemetry", [ case "beats" telemetry; case "end" telemetry_ends ]);
      ("runs", [ case "reproducible" reproducible; case "draws" draws_are_even ]) ]
