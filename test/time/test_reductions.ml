(* On random programs, the reductions make no difference: all dates, whether some run never ends, the missed
   [within], and the dates of the runs that are shown are those of the search that follows everything. Many of the
   programs execute copies of a task side by side, with plans that take the same time. PROGRAMS in the environment is
   how many programs are tried, 400 by default. *)

open Dolphin_time
open Random_missions

let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 400
let skipped = ref 0
let with_inert = ref 0 and with_likeness = ref 0
let few = { Dolphin_checker.Limits.none with max_states = Some 3_000 }

(* The whole output, but for the chosen runs. *)
let answers (o : Timed_analysis.outcome) =
  let task ((t : Timed_analysis.task), windows) = (t, List.sort compare windows) in
  let last (r : Timed_analysis.run option) =
    match r with
    | Some { dates = _ :: _ as dates; _ } -> Some (List.nth dates (List.length dates - 1))
    | Some _ | None -> None
  in
  let missed (site, missed) = (site, Option.map fst missed) in
  ( (List.sort compare o.endings, List.sort compare (List.map task o.tasks)),
    (List.sort compare (List.map missed o.deadlines), Option.map snd o.endless),
    (last o.last, last o.first, List.length o.unknown) )

let pp_dates ppf (endings, tasks) =
  let window ppf (w : Timed_analysis.window) =
    match w.latest with
    | At n -> Format.fprintf ppf "%d to %d" w.earliest n
    | Unbounded -> Format.fprintf ppf "%d or later" w.earliest
  in
  let ending (e, w) = Format.fprintf ppf "%s %a; " (Timed_system.ending_name e) window w in
  let task ((t : Timed_analysis.task), windows) =
    let moment (m, w) = Format.fprintf ppf "%s %a, " (Timed_system.moment_name m) window w in
    Format.fprintf ppf "%s on %s (%d): " t.name t.vehicle t.site;
    List.iter moment windows
  in
  List.iter ending endings;
  List.iter task tasks

let close = ref 0 and loose = ref 0

(* No bound is above what is left in any run that is shown. *)
let check_batteries (outcomes : Timed_analysis.outcome list) =
  let all = List.concat_map (fun (o : Timed_analysis.outcome) -> o.batteries) outcomes in
  let check (b : Timed_analysis.battery) (c : Timed_analysis.battery) =
    match c.lowest with
    | Some (lowest, _) when b.vehicle = c.vehicle && lowest < b.least -. 1e-9 ->
      QCheck2.Test.fail_reportf "%s: %g is left in a run, and %g or more is said" b.vehicle lowest b.least
    | Some _ | None -> ()
  in
  let count (b : Timed_analysis.battery) =
    let is_close = Option.fold b.lowest ~none:false ~some:(fun (lowest, _) -> lowest -. b.least < 1e-9) in
    Test_support.Property.count (if is_close then close else loose)
  in
  List.iter (fun b -> count b; List.iter (check b) all) all

let agrees case =
  let options = options case in
  let run reduction limits = Timed_analysis.run ~reduction ~vehicles:batteries limits options in
  let plain = run Timed_analysis.Nothing few in
  if plain.stopped <> None then Test_support.Property.count skipped
  else begin
    let check name reduction =
      let found = run reduction Dolphin_checker.Limits.none in
      let dates, kept, shown = answers plain and dates', kept', shown' = answers found in
      if dates <> dates' then
        QCheck2.Test.fail_reportf "%s: other dates: %a@.and not %a" name pp_dates dates' pp_dates dates;
      if kept <> kept' then QCheck2.Test.fail_reportf "%s: other verdicts" name;
      if shown <> shown' then begin
        let date = Option.fold ~none:"none" ~some:string_of_int in
        let text (last, first, unknown) = Printf.sprintf "%s, %s, %d unknown" (date last) (date first) unknown in
        QCheck2.Test.fail_reportf "%s: other runs: %s and not %s" name (text shown') (text shown)
      end;
      found
    in
    let inert = check "inert ends" Timed_analysis.Inert_ends in
    let all = check "inert ends and likeness" Inert_ends_and_canonical_states in
    check_batteries [ plain; inert; all ];
    if inert.reduction <> Nothing && inert.states <> plain.states then
      Test_support.Property.count with_inert;
    if all.reduction = Inert_ends_and_canonical_states && all.states <> inert.states then
      Test_support.Property.count with_likeness
  end;
  true

(* Later steps depend on the pairs left in N, or on their order. *)
let left uav after =
  "UUVs = pick { count 3; type 'UUV' }\nUAV = pick { type 'UAV' }\n\
   execute UUVs: (task('s1') >> action { post ready: 1 }) | (task('s2') >> action { post ready: 2 }), UAV: " ^ uav ^ "\n"
  ^ after

let one_of_two = "oneOf {\nwhen { consume ready: 1 } then task('v1')\nwhen { consume ready: 2 } then task('v2')\n}"

let check_left ~alike uav after =
  let case = (Mission (left uav after), (5, By_plan), ("as planned", answering)) in
  let found = Timed_analysis.run Dolphin_checker.Limits.none (options case) in
  Alcotest.(check bool) (after ^ ": the same is found") true (agrees case);
  Alcotest.(check bool) (after ^ ": likeness is used") alike (found.reduction = Inert_ends_and_canonical_states)

let test_left () =
  check_left ~alike:false one_of_two "if (poll(ready: 2)) {\n  execute idle(5)\n}\n";
  check_left ~alike:true "task('v')" "if (poll(ready: 2)) {\n  execute idle(5)\n}\n";
  check_left ~alike:true "task('v')" "post ready: 1\nif (poll(ready: 2)) {\n  execute idle(5)\n}\n";
  check_left ~alike:false "task('v')" "consume(ready: _)\nif (poll(ready: 2)) {\n  execute idle(5)\n}\n"

(* {1 Ends of tasks} *)

let of_text text = (Mission text, (5, By_plan), ("as planned", answering))

(* All that is posted or assigned is read. *)
let states copy =
  let pick = "last = 0\npost lock: 1\nUUVs = pick { count 3; type 'UUV' }\n" in
  let text = Printf.sprintf "%sexecute UUVs: %s\nx = [poll(ready: 1), last]\n" pick (numbered 3 " | " copy) in
  let found = Timed_analysis.run Dolphin_checker.Limits.none (options (of_text text)) in
  Alcotest.(check bool) (copy ^ ": likeness is used") true (found.reduction = Inert_ends_and_canonical_states);
  found.states

(* Tasks with [ensure] are alike as those whose next step does the same. *)
let test_ends_alike () =
  let no_more name ends by_hand = Alcotest.(check bool) name true (states ends <= states by_hand) in
  no_more "pairs" "((task('s') ensure { post ready: # }) >> idle(2))"
    "(task('s') >> action { post ready: # } >> idle(2))";
  no_more "variables" "((task('s') ensure { last = 1 }) >> idle(2))" "(task('s') >> action { last = 1 } >> idle(2))";
  no_more "a lock" "(using lock: 1 run task('s'))"
    "(waitFor { consume lock: 1 } then (task('s') >> action { post lock: 1 }))"

(* The last of two values is that of the right task: it is not like the left one. *)
let test_ends_in_order () =
  let cut deed after =
    Printf.sprintf
      "last = 0\nUUVs = pick { count 2; type 'UUV' }\n\
       execute UUVs: ((idle(9) >> task('s') ensure { %s }) | (idle(9) >> task('s') ensure { %s })) during 1\n%s\n"
      (deed 1) (deed 2) after
  in
  let check text = Alcotest.(check bool) (text ^ ": the same is found") true (agrees (of_text text)) in
  check (cut (Printf.sprintf "last = %d") "if (last == 2) { execute idle(7) }");
  check (cut (Printf.sprintf "post any: %d") "first = 1\nif (consume(any: 1)) { execute idle(7) }");
  check (cut (Printf.sprintf "post any: %d") "consume any: _\nif (poll(any: 2)) { execute idle(7) }")

(* {1 Sequences} *)

let test_sequences () =
  let check task =
    let text = Printf.sprintf "a = pick { id 'a' }\nb = pick { id 'b' }\nexecute %s\n" task in
    let agree seed = agrees (Mission text, (seed, By_plan), ("as planned", answering)) in
    Alcotest.(check bool) (task ^ ": the same is found") true (List.for_all agree (List.init 30 Fun.id))
  in
  List.iter check
    [ "(task('p')[a] >> task('q')[a]) | (task('r')[b] >> task('s')[b])";
      "task('p')[a] >> task('q')[b] >> task('r')[a]";
      "(idle(1) >> task('p')[b]) | (task('q')[a] >> idle(3))";
      "(task('p')[a] >> idle(2) >> task('q')[a]) | task('r')[b]";
      "(task('p')[a] >> idle(2) >> task('q')[a]) | (repeat 2, task('r')[b])";
      "(repeat 3, (task('p')[a] >> idle(2))) | (task('q')[b] >> (repeat 2, (task('r')[b] >> action { message 1 })))";
      "(watch (repeat 2, (watch task('p')[a] onError { ignore() })) onError { retry() }) | task('q')[b]";
      "(task('p')[a] >> task('q')[a]) | ((idle(2) >> task('r')[b]) during 1)";
      "((task('p')[a] >> task('q')[a]) | task('r')[b]) during 3";
      "(task('p')[a] >> action { message 1 / 0 } >> task('q')[a]) | (task('r')[b] >> task('s')[b])" ]

(* {1 How times are written} *)

let copies_of copy ~defined stay =
  let copies = Str.global_replace (Str.regexp_string "STAY") stay copy in
  Printf.sprintf "UUVs = pick { count 3; type 'UUV' }\nUAV = pick { type 'UAV' }\nstay = 0.1.min\nlater = stay\n%s\
                  execute UUVs: %s, UAV: allOf {\n%s\n}\n"
    defined (numbered 3 " | " copies) (numbered 3 "\n" "  when { consume ready: # } then task('v#')")

let staying = copies_of "(task('s#') >> action { post ready: # } >> idle(STAY))" ~defined:""

(* The time is the parameter of a function. *)
let staying_by defined =
  let work = "def work(i, t) {\n  task('s' + i) >> action { post ready: i } >> stay_for(t)\n}\n" in
  copies_of "work(#, STAY)" ~defined:(defined ^ work)

let found_of text = Timed_analysis.run Dolphin_checker.Limits.none (options (Mission text, (5, By_plan), ("as planned", answering)))

let test_spellings () =
  let literal = found_of (staying "6") in
  Alcotest.(check bool) "all is used" true (literal.reduction = Inert_ends_and_canonical_states);
  let check text stay =
    let found = found_of (text stay) in
    Alcotest.(check int) stay literal.states found.states;
    Alcotest.(check bool) (stay ^ ", the same dates") true (found.endings = literal.endings)
  in
  let spellings = [ "6.seconds"; "0.1.min"; "2 * 3"; "10 - 4"; "Math.max(2, 6)"; "stay"; "later"; "stay * 2 - 6" ] in
  List.iter (check staying) spellings;
  List.iter (check (staying_by "def stay_for(t) {\n  idle(t)\n}\n")) spellings;
  List.iter (check (staying_by "def stay_for(t) {\n  n = t + 1\n  n = n - 1\n  idle(n)\n}\n")) spellings

(* {1 Code that looks} *)

let looking code =
  "UUVs = pick { count 3; type 'UUV' }\nUAV = pick { type 'UAV' }\nfound = UUVs\n\
   execute UUVs: task('s1') | task('s2'), UAV: " ^ code ^ "\n"

let asked vs =
  Printf.sprintf
    "idle(9) >> oneOf {\n  when { %s.size() == 3 } then task('v')\n  when { %s.size() < 3 } then task('w')\n}" vs vs

let looks =
  [ ("who is idle", asked "idle(UUVs)");
    ("who runs", "idle(4) >> action { if (running(UAV)) { message 'it runs' } } >> task('v')");
    ("who has not started yet", "oneOf {\n  when { !running(found[0]) } then task('v')\n  when { running(found[0]) } then idle(1)\n}");
    ("who of a variable is idle", asked "idle(found)");
    ("a battery", "until { battery(UAV) < 0.5 } run (task('v') >> task('v'))");
    ("a position", "until { position(UAV).distanceTo(location(41, -8)) < 5 } run (task('v') >> task('v'))");
    ("an arrival", "until { eta(UAV, location(41, -8)) < 5 } run (task('v') >> task('v'))");
    ("dismissal", "watch (task('v') >> task('v')) onError { dismiss UAV }") ]

let test_look (name, code) =
  let check () =
    let case = (Mission (looking code), (5, By_plan), ("as planned", answering)) in
    Alcotest.(check bool) "the same is found" true (agrees case);
    let plain = Timed_analysis.run ~reduction:Nothing Dolphin_checker.Limits.none (options case) in
    Alcotest.(check int) "nothing is left out" plain.states (found_of (looking code)).states
  in
  Alcotest.test_case name `Quick check

(* A value that may only be a time may be vehicles, of which the held ones are asked for. *)
let test_asks () =
  let asks expected text =
    let program = Test_support.Pure_run.compile_exn ("vs = pick { count 2 }\n" ^ text) in
    Alcotest.(check bool) text expected (Dolphin_explore.Footprint.asks_held program)
  in
  let asked x = "execute action { if (idle(" ^ x ^ ").size() > 0) { post a: 1 } }\n" in
  List.iter (asks true)
    [ asked "vs"; "ws = vs\n" ^ asked "ws"; "ws = vs - vs\n" ^ asked "ws"; asked "vs + vs"; "x = 1\nx = vs\n" ^ asked "x";
      "m = [min: vs]\n" ^ asked "m.min";
      "x = 1\ndef f(v) {\n  execute idle(1) ensure { post((1): v); x = v }\n}\nf(vs)\n" ^ asked "x"; asked "true ? vs : 5";
      "def f(x) {\n  idle(x)\n}\ndef g(x) {\n  f(x)\n}\nmessage f(1)\nmessage g(vs)\n";
      "def f(x) {\n  idle(x)\n}\ng = f\nmessage f(1)\nmessage g(vs)\n";
      "def f(x) {\n  idle(x)\n}\nmessage f(1)\nmessage ([vs].collect(f))\n";
      "def f(x) {\n  x = vs\n  idle(x)\n}\nmessage f(1)\n";
      "def f(x) {\n  n = 1\n  for (y in 1..2) { if (y == 2) { n = x } }\n  idle(n)\n}\nmessage f(vs)\n";
      "def f(x) {\n  [1].collect { idle(x) }\n}\nmessage f(1)\n";
      "message ([vs].collect { x -> idle(x) })\n" ];
  List.iter (asks false)
    [ "execute idle(1.min)\n"; "x = 2\ny = x * 3 + 1\nx = y\nexecute idle(y - x + 60.seconds)\n";
      "x = 1\ndef f(v) {\n  execute idle(x) ensure { post((1): 'a'); x = v }\n}\nf(3)\n";
      "execute idle(true ? 1.min : 2)\n"; "def f(x) {\n  idle(x)\n}\nexecute f(1)\n";
      "def f(n, x) {\n  n == 0 ? idle(x) : f(n - 1, x + 1)\n}\nexecute f(3, 1)\n" ]

let test_agreement () =
  let test = QCheck2.Test.make ~count:programs ~print ~name:"what is left out makes no difference" case agrees in
  Test_support.Property.on_each_seed ~usual:20_261_123 ~programs test;
  Printf.printf "%d bounds of batteries exact, %d not\n" !close !loose;
  Printf.printf "%d skipped; %d with other states by inert ends, %d by likeness\n" !skipped !with_inert !with_likeness

let test_variety () =
  Alcotest.(check bool) "few are skipped" true (!skipped * 2 < programs);
  Alcotest.(check bool) "some have other states" true (!with_inert * 20 > programs && !with_likeness * 20 > programs);
  Alcotest.(check bool) "most bounds of batteries are exact" true (!close > 2 * !loose)

(* {1 Pairs that no code reads} *)

let unread =
  let case name text keys =
    let check () =
      let program = Test_support.Pure_run.compile_exn text in
      Alcotest.(check (list string)) "keys" keys (Unread_pairs.keys program)
    in
    Alcotest.test_case name `Quick check
  in
  [ case "posted, and never read" "post a: 1\npost b: 2, c: 3\nconsume c: _" [ "a"; "b" ];
    case "polled, consumed, counted"
      "post a: 1, b: 2, c: 3, d: 4, e: 5\nx = poll a: 1\ny = count(b: _)\nz = poll 'c'\n\
       execute waitFor { consume d: _ } then idle(1)" [ "e" ];
    case "posted by the outside" "input 'abort', 'go'\nexecute until { poll go: true } run idle(5)" [ "abort" ];
    case "read by the task of onInterrupt" "onInterrupt condition { poll a: 1 }\npost a: 1, b: 2" [ "b" ];
    case "read by a function that is not called" "def f() { poll a: 1 }\npost a: 1, b: 2" [ "b" ];
    case "posted by the end of a task" "execute (idle(1) ensure { post a: 1, b: 2 }) >> waitFor { consume b: _ } then idle(1)"
      [ "a" ];
    case "a computed key is read" "k = 'a'\npost a: 1\nconsume((k): _)" [];
    case "a computed key is posted" "k = 'a'\npost((k): 1)\npost b: 2" [ "b" ] ]

let () =
  Alcotest.run "reductions of time"
    [ ("random programs", [ Alcotest.test_case "what is left out makes no difference" `Quick test_agreement;
                            Alcotest.test_case "variety" `Quick test_variety ]);
      ("by hand",
       [ Alcotest.test_case "what is left in N" `Quick test_left;
         Alcotest.test_case "sequences" `Quick test_sequences;
         Alcotest.test_case "ends of tasks are alike" `Quick test_ends_alike;
         Alcotest.test_case "ends of tasks in their order" `Quick test_ends_in_order;
         Alcotest.test_case "how times are written" `Quick test_spellings;
         Alcotest.test_case "who asks" `Quick test_asks ]);
      ("pairs that no code reads", unread);
      ("code that looks", List.map test_look looks) ]
