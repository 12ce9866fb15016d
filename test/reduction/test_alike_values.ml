(* Values that are taken for one: the plain search finds the same verdicts and code reached as the reduced one, and each
   run that is shown is one of the semantics, on random pools of goals. Some look into a goal, or end otherwise on some.
   PROGRAMS in the environment is how many are tried, 1,000 by default. *)

open Dolphin_semantics
open Dolphin_environment
open Dolphin_explore
module Pure_run = Test_support.Pure_run

let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 1_000
let world = Test_support.Generate.world

let body =
  QCheck2.Gen.frequencyl
    [ (4, "{ g -> watch task(\"survey_$g\") onError { post goal: g; ignore() } }");
      (3, "{ g -> task(\"survey_$g\") }");
      (3, "{ g -> watch task(\"survey_$g\") onError { why -> message why; post lost: g; ignore() } }");
      (3, "{ g -> visit(g) }");
      (2, "{ g -> task(\"survey_$g\") >> action { message \"done $g\"; post over: g } }");
      (2, "{ g -> watch { task(\"survey_$g\") } onError { e -> message \"$e, ${e.vehicle}\"; retry() } }");
      (1, "{ g -> watch { task(\"survey_$g\") } onError { e ->\n\
           if (e.vehicle) { dismiss e.vehicle; post goal: g }\nignore() } }");
      (2, "{ g -> watch task(\"survey_$g\") onError { why -> post goal: g; fail \"$why: $g is left\" } }");
      (1, "{ g -> watch task(\"survey_$g\") onError { e -> last = e.task; ignore() } }");
      (1, "{ g -> watch task(\"survey_$g\") onError { e -> post lost: e.vehicle; ignore() } }");
      (1, "{ g -> action { post over: g, lost: g } }");
      (1, "{ task('home') }");
      (1, "{ visit(it) }");
      (1, "{ g -> { task(\"survey_$g\") } }");
      (1, "{ g -> action { if (g == 2) { halt 'two' } } }");
      (1, "{ g -> watch task(\"survey_$g\") onError { why -> post lost: \"$why\"; ignore() } }");
      (1, "{ g -> task(\"survey_$g\") >> action { last = g } }");
      (2, "{ g -> recruit { type 'UUV' } then { v -> task(\"survey_$g\") } }");
      (1, "{ g -> recruit { } then { v -> watch task(\"survey_$g\") onError { post goal: g, lost: v; ignore() } } }");
      (1, "{ g -> recruit { id (g == 1 ? 'c' : 'b') } then { v -> task('s') } }");
      (1, "{ g -> (waitFor { poll over: g } then task(\"survey_$g\")) during 3 }");
      (1, "{ g -> action { post over: \"$g\" } }");
      (1, "{ g -> task(\"$g\") }") ]

let guard =
  QCheck2.Gen.frequencyl
    [ (6, "consume goal: _"); (1, "consume goal: _, lost: _"); (1, "consume lost: _"); (1, "consume goal: 1");
      (1, "consume goal: { x -> x == 2 }"); (1, "count(goal: _) > 0 && consume(goal: _)"); (1, "take()") ]

let worker =
  let open QCheck2.Gen in
  let* guard = guard and* body = body in
  let wait = Printf.sprintf "(waitFor { %s } then %s)" guard body in
  frequencyl
    [ (2, wait);
      (2, Printf.sprintf "(oneOf { when { %s } then %s\nwhen { count(goal: _) == 0 } then action { } })" guard body);
      (2, Printf.sprintf "(repeat oneOf { when { %s } then %s\nwhen { !poll('goal') } then action { } }\n\
                          until { !poll('goal') })" guard body);
      (1, Printf.sprintf "(repeat recruit { type 'UUV' } then { %s } until { !poll('goal') })" wait);
      (1, wait ^ " >> " ^ wait) ]

let after =
  QCheck2.Gen.frequencyl
    [ (6, ""); (1, "if (poll(over: 1)) { halt 'one is over' }"); (1, "if (count(over: _) == 2) { halt 'two are over' }");
      (1, "if (poll(lost: _)) { consume lost: _ }"); (1, "while (count(lost: _) > 0) { consume lost: _ }");
      (1, "message \"last $last\"") ]

let source =
  let open QCheck2.Gen in
  let* first = worker and* second = worker and* after = after in
  let* goals = oneofl [ "1"; "1, 2"; "1, 2, 3"; "'1', 2.0"; "2, 2"; "'', 1" ] in
  return
    (Printf.sprintf
       "va = pick { id 'a' }\nvb = pick { id 'b' }\nlast = 0\ndef take() { consume(goal: _) }\n\
        def visit(goal) { watch task(\"visit_$goal\") onError { post goal: goal; ignore() } }\n\
        for (i in [%s]) { post goal: i }\nexecute %s[va] |\n        %s[vb]\n%s" goals first second after)

(* The same with a key of [fresh] for goals, in code that a function is given. *)
let of_fresh text =
  let computed = [ ("post goal: g, lost: v", "post((goal): g, lost: v)"); ("post goal: g", "post((goal): g)"); ("consume goal: _, lost: _", "consume((goal): _, lost: _)");
                   ("consume goal: _", "consume((goal): _)"); ("consume goal: 1", "consume((goal): 1)");
                   ("consume goal: { x -> x == 2 }", "consume((goal): { x -> x == 2 })");
                   ("consume(goal: _)", "consume((goal): _)"); ("count(goal: _)", "count((goal): _)");
                   ("poll('goal')", "poll((goal): _)") ]
  in
  let replace text (found, by) = Str.global_replace (Str.regexp_string found) by text in
  List.fold_left replace text computed

let source_of_fresh =
  let open QCheck2.Gen in
  let* first = worker and* second = worker and* after = after in
  let* goals = oneofl [ "1"; "1, 2"; "1, 2, 3"; "2, 2" ] in
  let* task = oneofl [ "visit"; "{ g -> task(\"work_$g\") }"; "{ g -> task(\"work_$g\") >> action { post over: g } }" ] in
  return
    (Printf.sprintf
       "va = pick { id 'a' }\nvb = pick { id 'b' }\nlast = 0\n\
        def visit(g) { watch task(\"visit_$g\") onError { ignore() } }\n\
        def pool(make) { fresh { goal ->\ndef take = { consume((goal): _) }\n\
        def given = waitFor { consume((goal): _) } then { g -> make(g) }\n\
        action { for (i in [%s]) { post((goal): i) } } >> (given[va] | %s[va] |\n  %s[vb]) } }\n\
        execute pool(%s) during 100\n%s"
       goals (of_fresh first) (of_fresh second) task after)

let by_name name ending =
  let endings _ p = if p = name then ending else Environment.Succeeds in
  { Environment.default with plans = [ name ]; endings }

let twice = Result.get_ok (Faults.of_string "all=2")

let environments =
  [ ("as planned", Environment.default); ("with failures", Environment.failing Environment.default);
    ("with a failure", Environment.failing ~failures:1 Environment.default);
    ("with losses", { Environment.default with faults = { Faults.none with loss = Any_number } });
    ("with all faults, twice", { Environment.default with faults = twice });
    ("with survey_1 failing", by_name "survey_1" Fails); ("with visit_2 that may fail", by_name "visit_2" May_fail);
    ("with survey_any failing", by_name "survey_any" Fails) ]

let used = ref 0 and skipped = ref 0 and fewer = ref 0

let agrees (source, (_, environment)) =
  let program = Pure_run.compile_exn source in
  match Agreement.check ~limit:1_500 ~reductions:[ All; Symmetry ] environment program world with
  | Error why -> QCheck2.Test.fail_report why
  | Ok None -> incr skipped; true
  | Ok (Some found) ->
    let o = Search.run { Search.default with environment; reduction = All } program world in
    if o.alike_values then begin
      Test_support.Property.count used;
      let por = Search.run { Search.default with environment; reduction = Partial_order } program world in
      if o.states < por.states then Test_support.Property.count fewer
    end;
    found.whole > 0

let test_agreement () =
  let print (source, (name, _)) = name ^ ":\n" ^ source in
  let test =
    QCheck2.Test.make ~count:programs ~print ~name:"reduced and plain search agree"
      QCheck2.Gen.(pair (frequency [ (2, source); (1, source_of_fresh) ]) (oneofl environments)) agrees
  in
  Test_support.Property.on_each_seed ~usual:20_261_124 ~programs test;
  Printf.printf "%d skipped; values were alike in %d, %d had fewer states\n" !skipped !used !fewer;
  if !used * 10 < programs || !fewer = 0 then Alcotest.fail "too few programs have values that are alike"

(* {1 One by one} *)

(* As many states as if all goals were the same. *)
let test_pool () =
  let worker v =
    Printf.sprintf
      "(repeat oneOf { when { consume goal: _ } then { g -> watch task(\"s_$g\") onError { post goal: g; ignore() } }\n\
       when { count(goal: _) == 0 } then action { } } until { count(goal: _) == 0 })[%s]" v
  in
  let states goals =
    let source =
      Printf.sprintf "va = pick { id 'a' }\nvb = pick { id 'b' }\nfor (i in [%s]) { post goal: i }\nexecute %s | %s" goals
        (worker "va") (worker "vb")
    in
    let environment = Environment.failing Environment.default in
    (Search.run { Search.default with environment; reduction = All } (Pure_run.compile_exn source) world).states
  in
  Alcotest.(check int) "states" (states "1, 1, 1, 1, 1, 1") (states "1, 2, 3, 4, 5, 6")

let test_team () =
  let states goals =
    let source =
      Printf.sprintf "include 'prelude'\nva = pick { id 'a' }\nvb = pick { id 'b' }\n\
                      execute team(1, 2, va + vb, [%s]) { g -> task(\"s_$g\") }" goals
    in
    let environment = Environment.failing Environment.default in
    let o = Search.run { Search.default with environment; reduction = All } (Pure_run.compile_exn source) world in
    Alcotest.(check bool) "alike" true o.alike_values;
    o.states
  in
  Alcotest.(check int) "states" (states "1, 1, 1, 1") (states "1, 2, 3, 4")

let uses ?(environment = Environment.default) source =
  let program = Pure_run.compile_exn source in
  Alike_values.unify environment program <> None

let pool ?(after = "") body =
  Printf.sprintf "post goal: 1, goal: 2\nexecute waitFor { consume goal: _ } then %s\n%s" body after

let posting = "{ g -> watch task(\"s_$g\") onError { post goal: g; ignore() } }"

let bringing key =
  let input = { (List.hd Test_support.Posts.inputs) with key } in
  { Environment.default with inputs = [ input ] }

(* A pool of a key of [fresh]; [made] is the task of its goal [g], and [make] is code for it. *)
let fresh ?(other = "") ?(before = "") made =
  Printf.sprintf
    "%s\ndef pool(goals, make) { fresh { goal ->\naction { for (i in goals) { post((goal): i) } } >>\n\
     (waitFor { consume((goal): _) } then { g -> watch %s onError { post((goal): g); ignore() } })%s } }\n\
     execute pool([1, 2]) { g -> task(\"s_$g\") }"
    before made other

let alike, apart =
  let is expected name ?environment source =
    Alcotest.test_case name `Quick (fun () -> Alcotest.(check bool) name expected (uses ?environment source))
  in
  ( [ is true "posted again" (pool posting); is true "counted" (pool ~after:"message \"${count(goal: _)}\"" posting);
      is true "asked for by its name" (pool ~after:"if (poll('goal')) { halt 'x' }" posting);
      is true "the vehicle of an error is used, and its text is that of another"
        (pool
           "{ g -> watch { task(\"s_$g\") } onError { e ->\n\
            if (e.vehicle) { dismiss e.vehicle; retry() } else fail \"$g: $e\" } }");
      is true "a vehicle is recruited for it"
        (pool "{ g -> recruit { type 'UUV' } then { v -> watch task(\"s_$g\") onError { post goal: g; ignore() } } }");
      is true "a key of fresh, and code that a function is given" (fresh "make(g)");
      is true "an input brings something else" ~environment:(bringing "x") (pool posting);
      is true "other plans are named" ~environment:(by_name "home" Fails) (pool posting) ],
    [ is false "a plan of such a name ends otherwise" ~environment:(by_name "s_2" Fails) (pool posting);
      is false "it says who is recruited" (pool "{ g -> recruit { id \"$g\" } then { v -> task('s') } }");
      is false "compared by who is recruited"
        (pool "{ g -> recruit { } then { v -> action { if (g == 1) { halt 'x' } } } }");
      is false "compared" (pool "{ g -> action { if (g == 1) { halt 'x' } } }");
      is false "asked for" (pool ~after:"if (poll(goal: 2)) { halt 'x' }" posting);
      is false "a key of fresh that is asked for" (fresh ~other:" | condition { !poll((goal): 2) }" "make(g)");
      is false "a key of fresh, counted by a pattern" (fresh ~other:" | condition { count((goal): { it > 1 }) == 0 }" "make(g)");
      is false "code that a function is given compares"
        (fresh ~other:" >> pool([3]) { g -> action { if (g == 1) { halt 'x' } } }" "make(g)");
      is false "code that a variable holds" (fresh ~before:"chosen = { g -> task(\"s_$g\") }" "chosen(g)");
      is false "a key of fresh, or another: a function is given both"
        (fresh ~before:"def asks(k) { condition { poll((k): 2) } }\nexecute watch asks('x') within 1 onError { ignore() }"
           ~other:" | asks(goal)" "make(g)");
      is false "a key of fresh that a variable holds"
        (fresh ~before:"kept = null" ~other:" >> action { kept = goal } >> condition { !poll((kept): 2) }" "make(g)");
      is false "asked for by a pattern" (pool ~after:"if (poll(goal: { it == 2 })) { halt 'x' }" posting);
      is false "posted where it is asked for"
        (pool ~after:"if (poll(seen: 2)) { halt 'x' }" "{ g -> action { post seen: g } }");
      is false "an input brings goals" ~environment:(bringing "goal") (pool posting);
      is false "an input brings what it is posted with" ~environment:(bringing "seen")
        (pool "{ g -> action { post seen: g } }");
      is false "a name of nothing else" (pool "{ g -> task(\"$g\") }");
      is false "asked for by a name that is computed" (pool ~after:"k = 'go' + 'al'\nif (poll(k)) { halt 'x' }" posting);
      is false "the task of an error is kept"
        (pool "{ g -> watch task(\"s_$g\") onError { e -> last = e.task; ignore() } }" |> ( ^ ) "last = 0\n");
      is false "the text of an error is posted"
        (pool "{ g -> watch task(\"s_$g\") onError { why -> post why: \"$why\"; ignore() } }");
      is false "the text of its error is posted further out"
        "post goal: 1\nexecute watch (waitFor { consume goal: _ } then { g -> task(\"s_$g\") })\n\
         onError { why -> post why: \"$why\"; ignore() }";
      is false "kept" (pool "{ g -> action { last = g } }" |> ( ^ ) "last = 0\n");
      is false "a key that is computed" (pool ~after:"k = 'go' + 'al'\nif (poll((k): 2)) { halt 'x' }" posting);
      is false "taken by a function" 
        ("def take() { consume(goal: _) }\npost goal: 1\nexecute waitFor { take() } then " ^ posting) ] )

(* {1 Order} *)

let orders =
  let of_fresh = Tuple_space.(with_prefix "#" (keys [ "x" ])) in
  let is name expected source =
    let check () =
      Alcotest.(check bool) name true ((Pure_run.compile_exn source).ordered_keys = (expected : Tuple_space.order))
    in
    Alcotest.test_case name `Quick check
  in
  let fresh = "post x: 1\nconsume x: _\nexecute fresh { k -> action { post((k): 1) } >> condition { consume((k): _) } }\n" in
  [ is "keys of fresh" of_fresh fresh;
    is "keys of fresh, and one that is computed for an equal value" of_fresh (fresh ^ "j = 'y'\nconsume((j): 1)");
    is "keys of fresh, and one that is computed for a pattern" Tuple_space.every_key
      (fresh ^ "j = 'y'\nconsume((j): { it > 1 })") ]

let () =
  Alcotest.run "alike values"
    [ ("order", orders); ("alike", alike); ("apart", apart);
      ("pool", [ Alcotest.test_case "different goals are as good as equal ones" `Quick test_pool;
                 Alcotest.test_case "of a team of the prelude, too" `Quick test_team ]);
      ("random programs", [ Alcotest.test_case "reduced and plain search agree" `Quick test_agreement ]) ]
