(* Looks at sensors do not contradict each other without any time in between. On random programs that go round by
   readings and the date, a run without events is found exactly if there is one in some world in which all sensors
   keep their values: each such world is closed, and its transitions are those of the semantics. All programs
   stand in a [during], so no fair run goes on without end in another way. PROGRAMS in the environment is how many are
   tried, 1,500 by default. *)

open Dolphin_semantics
open Dolphin_environment
open Dolphin_explore
module Generate = Test_support.Generate
module Pure_run = Test_support.Pure_run

let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 1_500

let open_world =
  World.at Any (World.open_battery "b" [] (World.open_battery "a" [] Generate.world))

(* {1 Worlds in which sensors keep their values} *)

let with_battery v x world =
  match World.find v world with
  | Some state -> World.add { state with battery = Some x } world
  | None -> Alcotest.failf "no vehicle %s" v

let shares = [ 0.1; 0.3; 0.45; 0.6; 0.9 ]

let closed_worlds =
  let world a b date = World.at (Exactly date) (with_battery "b" b (with_battery "a" a Generate.world)) in
  List.concat_map (fun a -> List.concat_map (fun b -> List.map (world a b) [ 0; 60; 100 ]) shares) shares

let is_event (t : Transition.t) =
  match t.label with Done _ | Fail _ | Time_out | Resume -> true | _ -> false

(* Whether some run goes round without events in [world], from some state of [g]. *)
let spins_in (g : Reference.t) world =
  let colours = Hashtbl.create 100 in
  let key (c, e) = (Configuration.hash c, c, e) in
  let same (h, c, e) (h', c', e') = h = h' && Configuration.equal c c' && Environment.compare e e' = 0 in
  let find k = List.find_opt (fun (k', _) -> same k k') (Hashtbl.find_all colours (let h, _, _ = k in h)) in
  let rec visit state =
    let ((h, c, e) as k) = key state in
    match find k with
    | Some (_, colour) -> !colour = `On_path
    | None ->
      let colour = ref `On_path in
      Hashtbl.add colours h (k, colour);
      let next ((t : Transition.t), e) = if is_event t then None else Some (t.next, e) in
      let choices = Seq.filter_map next (Environment.choices g.options g.program world e c) in
      let found = List.exists visit (List.of_seq choices) in
      colour := `Left;
      found
  in
  Array.exists (fun (s : Reference.state) -> visit (s.configuration, s.outside)) g.states

(* One for each outcome of the readings of {!reading}. *)
let few_worlds =
  let world a b = World.at (Exactly 0) (with_battery "b" b (with_battery "a" a Generate.world)) in
  List.concat_map (fun a -> List.map (world a) [ 0.1; 0.9 ]) [ 0.1; 0.35; 0.5; 0.9 ]

(* Whether some run goes round if sensors keep their values until the next event, from some state of [g]. Scripts wait
   for events only. *)
let goes_round (g : Reference.t) =
  let worlds = few_worlds in
  let colours = Hashtbl.create 100 in
  let same (w, c, e) (w', c', e') = Int.equal w w' && Configuration.equal c c' && Environment.compare e e' = 0 in
  let all = List.init (List.length worlds) Fun.id in
  let choices w (c, e) = List.of_seq (Environment.choices g.options g.program (List.nth worlds w) e c) in
  let rec visit w (c, e) =
    let w = match c.Configuration.control with Waiting _ -> 0 | Script _ | Executing _ | Ended _ -> w in
    let hash = Configuration.hash c in
    match List.find_opt (fun (k, _) -> same k (w, c, e)) (Hashtbl.find_all colours hash) with
    | Some (_, colour) -> !colour = `On_path
    | None ->
      let colour = ref `On_path in
      Hashtbl.add colours hash ((w, c, e), colour);
      let goes_on w ~event =
        List.exists (fun ((t : Transition.t), e) -> is_event t = event && visit w (t.next, e)) (choices w (c, e)) in
      let found =
        goes_on w ~event:false || List.exists (fun w -> goes_on w ~event:true) all in
      colour := `Left;
      found
  in
  let from (s : Reference.state) = List.exists (fun w -> visit w (s.configuration, s.outside)) all in
  Array.exists from g.states

(* {1 Programs} *)

let guard =
  QCheck2.Gen.oneofl
    [ "battery(v1) < 0.3"; "battery(v1) >= 0.3"; "battery(v1) > 0.6"; "battery(v1) <= 0.45"; "battery(v2) < 0.3";
      "battery(v2) > 0.3"; "now() >= 60"; "now() < 60"; "now() > 60"; "battery(v1) < 0.3 && now() < 60";
      "battery(v1) < 0.3 || battery(v2) > 0.6"; "h == 1"; "poll k: 1"; "consume k: 1" ]

let leaf part =
  let open QCheck2.Gen in
  frequency
    [ (5, map (Printf.sprintf "condition { %s }") guard);
      (2, return (Printf.sprintf "task('p')[v%d]" part));
      (1, return "idle(1)"); (1, return "action { h = 1 - h }"); (1, return "action { post k: 1 }");
      (1, map (Printf.sprintf "action { if (%s) h = 1 else h = 0 }") guard) ]

let rec task depth part =
  let open QCheck2.Gen in
  if depth = 0 then leaf part
  else
    let inside = task (depth - 1) part in
    frequency
      [ (2, leaf part);
        (4, map2 (Printf.sprintf "(%s >> %s)") inside inside);
        (3, map2 (Printf.sprintf "(until { %s } run %s)") guard inside);
        (3, map2 (fun (g, g') (t, t') -> Printf.sprintf "oneOf { when { %s } then %s\nwhen { %s } then %s }" g t g' t')
           (pair guard guard) (pair inside inside));
        (1, map (Printf.sprintf "(watch %s onError { retry() })") inside);
        (1, map2 (Printf.sprintf "(repeat %s until { %s })") inside guard) ]

let source =
  let open QCheck2.Gen in
  let* n = int_range 1 2 in
  let* parts = flatten_l (List.init n (fun i -> task 2 (i + 1))) in
  let around t = Printf.sprintf "(repeat %s)" t in
  return
    ("v1 = pick { id 'a' }\nv2 = pick { id 'b' }\nh = 0\n"
     ^ Printf.sprintf "execute (%s) during 9" (String.concat " | " (List.map around parts)))

(* {2 Scripts} *)

let reading = QCheck2.Gen.oneofl [ "battery(v1) < 0.3"; "battery(v1) >= 0.45"; "battery(v1) > 0.6"; "battery(v2) < 0.3" ]

let rec statement depth =
  let open QCheck2.Gen in
  let simple =
    frequency
      [ (3, return "pause 1"); (2, return "execute task('p')[v1]"); (2, map (Printf.sprintf "h = %s") reading);
        (3, map (Printf.sprintf "if (%s) halt 'reading'") reading);
        (1, map (Printf.sprintf "if (h == (%s)) halt 'the same'") reading); (1, return "message 'm'") ]
  in
  if depth = 0 then simple
  else
    let either c a b = Printf.sprintf "if (%s) { %s } else { %s }" c a b in
    frequency [ (3, simple); (2, map3 either reading (statements (depth - 1)) (statements (depth - 1))) ]

and statements depth =
  let open QCheck2.Gen in
  map (String.concat "\n") (list_size (int_range 1 3) (statement depth))

let script =
  let open QCheck2.Gen in
  let* test = oneof [ return "true"; reading ] in
  let* before = statement 0 and* body = statements 2 in
  return
    (Printf.sprintf "v1 = pick { id 'a' }\nv2 = pick { id 'b' }\nh = true\n%s\nwhile (%s) {\n%s\n}\n" before test body)

(* {1 Comparison} *)

let found = Hashtbl.create 3
let note what = Hashtbl.replace found what (1 + Option.value ~default:0 (Hashtbl.find_opt found what))

let said (verdict : Search.verdict) =
  match verdict with
  | Holds -> "holds"
  | Holds_if _ -> "holds if"
  | Violated _ -> "violated"
  | By_design _ -> "by design"
  | Unreached _ | Inconclusive _ -> "inconclusive"

let reductions = [ Reduction.Whole; Partial_order; All ]

let verdict ?(property = Property.Termination) ?(search_again = 0) program world reduction =
  let o = Search.run { Search.default with reduction; search_again } program world in
  said (List.assoc property o.verdicts)

(* Runs of worlds are searched again. *)
let of_worlds property = verdict ~property ~search_again:Search.default.search_again

let each_is expected verdict =
  let is_expected reduction =
    let found = verdict reduction in
    found = expected
    || QCheck2.Test.fail_reportf "%s, %s expected (%s)" found expected (String.concat ", " (Reduction.names reduction))
  in
  List.for_all is_expected reductions

let agrees source =
  match Pure_run.compile source with
  | Error _ -> note "refused"; true
  | Ok program -> (
      match Reference.explore ~limit:400 Environment.default program open_world with
      | None | (exception Environment.Unclear _) -> note "skipped"; true
      | Some g ->
        let expected = if List.exists (spins_in g) closed_worlds then "violated" else "holds" in
        note expected;
        each_is expected (verdict program open_world))

let test_random () =
  let test = QCheck2.Test.make ~count:programs ~print:Fun.id ~name:"spins are those of some world" source agrees in
  Test_support.Property.on_each_seed ~usual:20_261_127 ~programs test;
  Hashtbl.iter (Printf.printf "%s: %d\n") found

let script_agrees source =
  let program = Pure_run.compile_exn source in
  match Reference.explore ~limit:100 Environment.default program open_world with
  | None | (exception Environment.Unclear _) -> note "skipped"; true
  | Some g ->
    let expected = if goes_round g then "violated" else "holds" in
    note ("script " ^ expected);
    each_is expected (verdict program open_world)

let test_scripts () =
  let count = programs / 30 in
  let test = QCheck2.Test.make ~count ~print:Fun.id ~name:"scripts go round as some world does" script script_agrees in
  Test_support.Property.on_each_seed ~usual:20_261_129 ~programs:count test;
  Hashtbl.iter (Printf.printf "%s: %d\n") found

(* {1 Halts} *)

let dated_worlds =
  let world a b date = World.at (Exactly date) (with_battery "b" b (with_battery "a" a Generate.world)) in
  let dates = [ 0; 60; 100 ] in
  List.concat_map
    (fun a -> List.concat_map (fun b -> List.map (fun date -> (date, world a b date)) dates) [ 0.1; 0.9 ])
    [ 0.1; 0.35; 0.5; 0.9 ]

(* Whether some run halts if sensors keep their values until the next event, or while a task has a step of its own, and
   the date does not go back. *)
let halts (g : Reference.t) =
  let seen = Hashtbl.create 100 in
  let same (w, c, e) (w', c', e') = Int.equal w w' && Configuration.equal c c' && Environment.compare e e' = 0 in
  let worlds = Array.of_list dated_worlds in
  let later w = List.filter (fun w' -> fst worlds.(w') >= fst worlds.(w)) (List.init (Array.length worlds) Fun.id) in
  let choices w c e = List.of_seq (Environment.choices g.options g.program (snd worlds.(w)) e c) in
  let steps ~event w c e = List.filter (fun ((t : Transition.t), _) -> is_event t = event) (choices w c e) in
  let rec visit (w, c, e) =
    let key = Configuration.hash c in
    (not (List.exists (same (w, c, e)) (Hashtbl.find_all seen key)))
    && begin
      Hashtbl.add seen key (w, c, e);
      let take w ((t : Transition.t), e) =
        match t.next.control with
        | Ended (Halted _) -> true
        | Script _ | Waiting _ | Executing _ | Ended _ -> visit (w, t.next, e)
      in
      let own = steps ~event:false w c e in
      let waits =
        match c.Configuration.control with
        | Waiting _ -> true
        | Executing _ -> own = []
        | Script _ | Ended _ -> false
      in
      List.exists (take w) own
      || (waits && List.exists (fun w' -> visit (w', c, e)) (later w))
      || List.exists (fun w' -> List.exists (take w') (steps ~event:true w' c e)) (later w)
    end
  in
  let start = g.states.(0) in
  List.exists (fun w -> visit (w, start.configuration, start.outside)) (List.init (Array.length worlds) Fun.id)

let dated = QCheck2.Gen.(oneof [ reading; oneofl [ "now() > 60"; "now() < 60"; "now() >= 60"; "now() <= 60" ] ])

let halting_task =
  let open QCheck2.Gen in
  let halt =
    map2 (Printf.sprintf "(condition { %s } >> action { if (%s) halt 'reading' })") dated dated in
  let leaf v =
    oneof
      [ halt; map (Printf.sprintf "condition { %s }") dated; return (Printf.sprintf "task('p')[v%d]" v);
        return "idle(1)";
        map (Printf.sprintf "action { h = %s }") dated ]
  in
  let either (g, g') (t, t') = Printf.sprintf "oneOf { when { %s } then %s\nwhen { %s } then %s }" g t g' t' in
  let small =
    frequency
      [ (2, leaf 1); (2, map2 (Printf.sprintf "(until { %s } run %s)") dated (leaf 1));
        (2, map2 either (pair dated dated) (pair (leaf 1) (leaf 2)));
        (2, map2 (Printf.sprintf "(%s | %s)") (leaf 1) (leaf 2)) ]
  in
  map2 (Printf.sprintf "%s >> %s") small small

let halting =
  let open QCheck2.Gen in
  let statement =
    frequency
      [ (2, map (Printf.sprintf "execute %s") halting_task);
        (4, map2 (Printf.sprintf "if (%s) { message 'm'\nif (%s) halt 'both' }") dated dated);
        (1, map (Printf.sprintf "h = %s") dated); (1, map (Printf.sprintf "if (h == (%s)) halt 'the same'") dated);
        (1, return "pause 1") ]
  in
  let+ body = list_size (int_range 1 3) statement in
  "v1 = pick { id 'a' }\nv2 = pick { id 'b' }\nh = true\n" ^ String.concat "\n" body

let halts_agree source =
  let program = Pure_run.compile_exn source in
  match Reference.explore ~limit:300 Environment.default program open_world with
  | None | (exception Environment.Unclear _) -> note "skipped"; true
  | Some g ->
    let expected = if halts g then "violated" else "holds" in
    note ("halt " ^ expected);
    if expected = "holds" && List.mem_assoc Property.No_halt (Reference.broken g) then note "halt in no world";
    each_is expected (of_worlds No_halt program open_world)

let test_halts () =
  let count = programs / 5 in
  let test = QCheck2.Test.make ~count ~print:Fun.id ~name:"programs halt as some world has it" halting halts_agree in
  Test_support.Property.on_each_seed ~usual:20_261_130 ~programs:count test;
  Hashtbl.iter (Printf.printf "%s: %d\n") found

let test_variety () =
  let enough share what =
    if Option.value ~default:0 (Hashtbl.find_opt found what) * share < programs then
      Alcotest.failf "too few programs for: %s" what
  in
  List.iter (enough 40) [ "holds"; "violated" ];
  List.iter (enough 750) [ "script holds"; "script violated" ];
  List.iter (enough 100) [ "halt holds"; "halt violated"; "halt in no world" ]

(* {1 Examples} *)

let head = "v = pick { id 'a' }\nw = pick { id 'b' }\nh = 0\npost k: 1\n"

let examples =
  [ (* The battery is low, then it is not, then it is low. *)
    ( "repeat oneOf {\n\
       when { battery(v) < 0.3 } then (until { battery(v) >= 0.3 } run task('p'))\n\
       when { battery(v) >= 0.3 } then (until { battery(v) < 0.3 } run task('q'))\n\
       }", "by design" );
    ("repeat (condition { battery(v) < 0.3 } >> condition { battery(v) >= 0.3 })", "by design");
    ("repeat (condition { battery(v) < 0.3 } >> condition { battery(v) > 0.5 })", "by design");
    ("repeat (condition { battery(v) < 0.3 } >> condition { battery(v) < 0.5 })", "violated");
    ("repeat (condition { battery(v) < 0.3 } >> condition { battery(w) >= 0.3 })", "violated");
    (* A date that has passed stays passed, whatever happens in between. *)
    ("repeat (condition { now() > 60 } >> condition { now() < 60 })", "by design");
    ("repeat (condition { poll k: 1 } >> action { h = now() > 60 } >>\n\
      action { if (h == (now() > 60)) halt 'same' })", "holds");
    ("repeat (action { h = now() > 60 } >> idle(1) >> action { if (h == (now() > 60)) halt 'same' })", "holds");
    ("repeat (condition { poll k: 1 } >> action { h = battery(v) > 0.6 } >>\n\
      action { if (h == (battery(v) > 0.6)) halt 'same' })", "holds");
    ("repeat (action { h = battery(v) > 0.6 } >> idle(1) >> action { if (h == (battery(v) > 0.6)) halt 'same' })",
     "by design");
    ("(repeat oneOf {\n\
      when { now() > 60 } then (until { now() <= 60 } run task('p'))\n\
      when { now() <= 60 } then (until { now() > 60 } run task('q'))\n\
      }) during 2.hours", "holds");
    ("repeat (condition { now() > 60 } >> idle(1) >> condition { now() > 30 })", "by design");
    ("repeat (condition { now() > 60 } >> condition { now() > 30 })", "violated");
    (* A kept reading is of another moment than the next. *)
    ("repeat (action { h = battery(v) } >> condition { h < 0.3 } >> action { h = battery(w) } >>\n\
      condition { h >= 0.3 })", "violated") ]

let scripts =
  [ ("while (true) { message 'a'; h = battery(v) < 0.3; message 'b'; if (h == (battery(v) < 0.3)) halt 'same' }",
     "holds");
    ("while (true) { message 'a'; h = battery(v) < 0.3; pause 1; if (h == (battery(v) < 0.3)) halt 'same' }",
     "violated");
    ("while (true) { execute condition { battery(v) < 0.3 }; execute condition { battery(v) >= 0.3 } }", "violated");
    ("while (battery(v) < 0.3) { message 'low' }", "violated");
    ("while (true) { pause 1; h = battery(v) < 0.3; message 'b'; if (h == (battery(v) < 0.3)) halt 'same' }", "holds");
    ("while (true) { execute task('p')[v]; if (battery(v) < 0.3) { message 'a'; if (battery(v) < 0.5) halt 'low' }\n\
      else { message 'b'; if (battery(v) >= 0.3) halt 'high' } }", "holds");
    ("late = false\nwhile (!late || now() <= 60) { pause 10; late = now() > 60 }", "violated");
    ("while (true) { pause 10; if (now() <= 60) halt 'early'; pause 10; if (now() > 60) halt 'late' }", "holds") ]

let finite =
  [ ("if (battery(v) < 0.3) { message 'a'\nassert { battery(v) < 0.5 } }", "holds");
    ("if (battery(v) < 0.3) { pause 1\nassert { battery(v) < 0.5 } }", "violated");
    ("if (now() > 60) { pause 1\nassert { now() > 60 } }", "holds");
    ("if (now() < 60) { pause 1\nassert { now() < 60 } }", "violated");
    (* A guard that was waited for was not met before: then 1:00 had passed. *)
    ("execute condition { battery(v) < 0.3 }\nexecute condition { now() < 60 } >> action { assert { battery(v) < 0.5 } }",
     "holds");
    ("execute condition { battery(v) < 0.3 }\nexecute condition { now() > 60 } >> action { assert { battery(v) < 0.5 } }",
     "violated");
    (* An event may come before the run halts. *)
    ("if (battery(v) < 0.3) {\nmessage 'a'\nassert { battery(v) < 0.5 }\n\
      execute (task('p')[v] >> action { assert { battery(v) < 0.5 } }) | action { halt 'stop' }\n}", "violated") ]

let test_finite (text, expected) () =
  let program = Pure_run.compile_exn (head ^ text) in
  let check reduction =
    Alcotest.(check string) text expected (of_worlds Assertions program open_world reduction) in
  List.iter check reductions

let test_example (text, expected) () =
  let program = Pure_run.compile_exn (head ^ text) in
  let check reduction =
    let names = String.concat ", " (Reduction.names reduction) in
    Alcotest.(check string) (names ^ ": " ^ text) expected (verdict program open_world reduction)
  in
  List.iter check reductions

let formula program text ~fairness =
  let f = match Temporal.of_string program text with Ok f -> f | Error why -> failwith why in
  let o = Search.run { Search.default with formulas = [ f ]; fairness } program open_world in
  said (snd (List.find (fun (p, _) -> match p with Property.Formula _ -> true | _ -> false) o.verdicts))

let test_formulas () =
  let program =
    Pure_run.compile_exn
      (head ^ "execute (repeat (condition { battery(v) < 0.3 } >> condition { battery(v) >= 0.3 })) during 9") in
  Alcotest.(check string) "F ended" "holds" (formula program "F ended" ~fairness:Weak);
  let spinning =
    Pure_run.compile_exn
      (head ^ "execute (repeat (condition { battery(v) < 0.3 } >> condition { battery(v) < 0.5 })) during 9") in
  Alcotest.(check string) "F ended" "violated" (formula spinning "F ended" ~fairness:Weak);
  let in_script =
    Pure_run.compile_exn
      (head ^ "while (poll(k: _)) { execute until { poll k: 1 } run (task('p')[v] >> action { consume k: 1 }) }") in
  Alcotest.(check string) "F ended" "violated" (formula in_script "F ended" ~fairness:Strong);
  let kept sensor = Pure_run.compile_exn (head ^ "execute repeat (action { h = " ^ sensor ^ " > 60 } >> idle(1))") in
  let stays = "F G { h == true } | F G { h == false } | G F !timeout & !G F timeout" in
  Alcotest.(check string) "date" "holds" (formula (kept "now()") stays ~fairness:Weak);
  Alcotest.(check string) "date" "holds" (formula (kept "now()") stays ~fairness:No_fairness);
  Alcotest.(check string) "battery" "violated" (formula (kept "battery(v)") stays ~fairness:Weak)

let test_moments () =
  let low = World.Claim ("battery(a) < 0.3", true) and not_low = World.Claim ("battery(a) < 0.3", false) in
  let other = World.Claim ("battery(b) < 0.3", true) in
  let check what moment looks expected =
    let found = Looks.after (fun _ -> true) moment looks in
    Alcotest.(check bool) what true (List.equal (fun a b -> Looks.compare_moments a b = 0) found expected)
  in
  check "a look is kept" Looks.beginning [ [ low ] ] [ [ low ] ];
  check "a contradiction" [ not_low ] [ [ low ] ] [];
  check "one of two lists" [ not_low ] [ [ low ]; [ other ] ] (Looks.after (fun _ -> true) [ not_low ] [ [ other ] ]);
  check "the moment that knows less" [ low ] [ [ other; low ]; [ low ] ] [ [ low ] ];
  check "neither knows less" Looks.beginning [ [ low ]; [ other ] ] [ [ low ]; [ other ] ]

let () =
  let case name f = Alcotest.test_case name `Quick f in
  Alcotest.run "looks"
    [ ("tasks", List.map (fun (text, expected) -> case text (test_example ("execute " ^ text, expected))) examples);
      ("scripts", List.map (fun (text, expected) -> case text (test_example (text, expected))) scripts);
      ("runs with an end", List.map (fun (text, expected) -> case text (test_finite (text, expected))) finite);
      ("moments", [ case "after a step" test_moments ]);
      ("formulas", [ case "cycles that no world has" test_formulas ]);
      ("random programs",
       [ case "a spin is one of some world" test_random; case "scripts go round as worlds do" test_scripts;
         case "halts are those of some world" test_halts; case "there are programs of both kinds" test_variety ]) ]
