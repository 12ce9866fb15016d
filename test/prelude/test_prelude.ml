(* Each function of the prelude: its example runs, its law holds as strong bisimilarity and its weak one as weak
   bisimilarity, and its documented property holds in all runs. *)

open Dolphin_semantics
open Dolphin_syntax
open Test_support

let given =
  "include 'prelude'\n\
   vs = pick { type 'UUV'; count 3 }\n\
   p = imcPlan('p')\n\
   q = imcPlan('q')\n\
   r = imcPlan('r')\n"

let compile body =
  let read path = Error (path ^ ": there is no such file") in
  let { Include.text; _ }, parsed = Include.program ~read ~file:"test.dol" (given ^ body ^ "\n") in
  match Result.bind parsed (Elaborate.program ~source_name:"test.dol") with
  | Ok (program, []) -> program
  | Ok (_, found) | Error found -> failwith (Pure_run.explain text found)

let graph ?failures body =
  match Graph.explore ~limit:20_000 ?failures (compile body) (World.at Any Pure_run.fleet) with
  | Some graph -> graph
  | None -> Alcotest.fail "more states than expected"

let ends (g : Graph.t) =
  let ends = ref [] in
  Array.iteri (fun i edges -> if edges = [] then ends := g.states.(i) :: !ends) g.edges;
  !ends

(* A vehicle's failure, whichever vehicle's. *)
let broken = "failed: a vehicle"

let is_broken message =
  let n = String.length message and suffix = ": broken" in
  n > String.length suffix && String.sub message (n - String.length suffix) (String.length suffix) = suffix

let how (c : Configuration.t) =
  match c.control with
  | Ended Completed -> "completed"
  | Ended (Failed { message; _ }) when is_broken message -> broken
  | Ended (Failed fault) -> "failed: " ^ fault.message
  | Ended (Halted _ | Interrupted) -> "halted"
  | _ -> "stuck"

let outcomes ?failures body = List.sort_uniq compare (List.map how (ends (graph ?failures body)))

(* {1 Examples and laws} *)

(* Rounds without end have no last state. *)
let example (e : Prelude.entry) =
  let check () =
    Alcotest.(check (list string)) "how runs end" [ "completed" ] (outcomes ~failures:false e.example) in
  Alcotest.test_case (e.name ^ ": the example") `Quick check

let law (e : Prelude.entry) =
  let check (a, b) () =
    let graph task = graph ("execute " ^ task) in
    Alcotest.(check bool) "bisimilar" true
      (Bisimulation.equivalent ~observed:Bisimulation.shared (graph a) (graph b)) in
  Option.map (fun law -> Alcotest.test_case (e.name ^ ": the law") `Quick (check law)) e.law

let weak_law (e : Prelude.entry) =
  let check (a, b) () =
    let graph task = graph ("execute " ^ task) in
    Alcotest.(check bool) "weakly bisimilar" true (Bisimulation.weakly_equivalent (graph a) (graph b)) in
  Option.map (fun law -> Alcotest.test_case (e.name ^ ": the weak law") `Quick (check law)) e.weak_law

(* Weak bisimilarity is not trivial. *)
let no_weak_law (a, b) =
  let check () =
    let graph task = graph ("execute " ^ task) in
    Alcotest.(check bool) "weakly bisimilar" false (Bisimulation.weakly_equivalent (graph a) (graph b)) in
  Alcotest.test_case (Printf.sprintf "%s is not %s" a b) `Quick check

let no_weak_laws =
  List.map no_weak_law
    [ ("p >> q", "p | q"); ("p", "q"); ("p", "p until { true }"); ("p >> action { halt() }", "p");
      ("atLeast(2, [p, q, r])", "p | q | r"); ("leader('a', [p]) | follower('a', [q])", "p | q");
      ("team(1, 2, vs, [p, q]) { g -> g }", "(p >> q)[vs[0]]");
      ("forall(vs) { v -> p >> barrier('x', 2) >> q }", "forall(vs) { v -> p } >> forall(vs) { v -> q }") ]

let told () =
  let functions =
    match Parse.program ~file:Prelude.file Prelude.text with
    | Ok ast ->
      List.filter_map (fun (s : Ast.statement) -> match s.it with Function { name; _ } -> Some name.it | _ -> None) ast
    | Error _ -> []
  in
  Alcotest.(check (list string)) "each function has its comment" functions
    (List.map (fun (e : Prelude.entry) -> e.name) (Prelude.entries ()))

(* {1 Documented properties} *)

let holds ?(ends = [ "completed" ]) ?(failures = false) title body =
  Alcotest.test_case title `Quick (fun () -> Alcotest.(check (list string)) "ends" ends (outcomes ~failures body))

let leaves_nothing body () =
  let is_empty (c : Configuration.t) = Tuples.is_empty c.shared.tuples in
  Alcotest.(check bool) "N is empty at each end" true (List.for_all is_empty (ends (graph ~failures:false body)))

let nothing title body = Alcotest.test_case title `Quick (leaves_nothing body)

let meeting = "par([1, 2].collect { i -> action { came++ } >> barrier('x', 2) >> action { if (came < 2) { halt() } } >>\n\
              \  barrier('x', 2) >> action { came = 0 } })"

let with_failures team =
  "bad = 0\nexecute " ^ team
  ^ ", vs, ['p', 'q']) { g -> watch imcPlan(g) onError { bad++\n propagate() } }\nassert { bad == 0 }"

let goals urgencies =
  let post u = Printf.sprintf "post goal: %d\n" u in
  String.concat "" (List.map post urgencies)

let inspection vs = Printf.sprintf "byPriority(%s, 'goal', { it }) { g -> imcPlan { locate g, 2; goTo() } }" vs

let told_of_themselves =
  [ holds "race: one is done, whichever" "n = 0\nexecute race([p >> action { n++ }, q >> action { n++ }])\nassert { n >= 1 }";
    holds "race: not all need be done" ~ends:[ "completed"; "failed: assertion failed" ]
      "n = 0\nexecute race([p >> action { n++ }, q >> action { n++ }])\nassert { n == 2 }";
    holds "race: an error is one of the race" ~failures:true ~ends:[ "completed"; broken ] "execute race([p, q])";
    holds "race: again and again" "n = 0\nwhile (n < 3) { execute race([p, q])\n n++ }";
    holds "race: two of the same tasks at once, each by itself"
      "n = 0\n\
       short = action { n++ }\n\
       def t() { race([short, condition { false }]) }\n\
       execute t() | t()\n\
       assert { n == 2 }";
    holds "race: round after round" "n = 0\nexecute repeat 3, race([action { n++ }, condition { false }])\nassert { n == 3 }";
    holds "fresh: a round that is cut off leaves nothing to the next"
      "n = 0\n\
       def t() {\n\
       fresh { k -> action { if (!poll((k): 1)) { n++ }\n post((k): 1, x: 1) } >> condition { false } }\n\
       }\n\
       execute repeat 2, (t() until { consume x: 1 })\n\
       assert { n == 2 }";
    holds "fresh: pairs posted after its end last until the executed task is over"
      "n = 0\n\
       key = ''\n\
       execute fresh { k -> action { key = k } } >> action { post((key): 1) } >>\n\
       condition { poll((key): 1) } >> action { n++ }\n\
       assert { n == 1 && !poll((key): 1) }";
    holds "race: two of the same tasks, of which one is cut off" ~failures:true ~ends:[ "completed" ]
      "n = 0\n\
       def t() { race([watch p onError { ignore() }, condition { false }]) >> action { n++ } }\n\
       execute (t() until { n > 0 }) | t()\n\
       assert { n >= 1 }";
    holds "parallel: never more at once"
      "n = 0\n\
       def t(x) { action { n++\n if (n > 2) { halt() } } >> x >> action { n-- } }\n\
       execute parallel(2, [t(p), t(q), t(r)])\n\
       assert { n == 0 }";
    holds "parallel: as many at once" ~ends:[ "completed"; "halted" ]
      "n = 0\n\
       def t(x) { action { n++\n if (n > 1) { halt() } } >> x >> action { n-- } }\n\
       execute parallel(2, [t(p), t(q), t(r)])";
    nothing "parallel: leaves nothing" "execute parallel(2, [p, q, r])";
    holds "team: two with the same goals at once"
      "n = 0\n\
       def t(v) { team(1, 1, v, ['p', 'q']) { g -> imcPlan(g) >> action { n++ } } }\n\
       execute t(vs[0]) | t(vs[1])\n\
       assert { n == 4 }";
    holds "barrier: two of one task at once, with a fresh name"
      "n = 0\n\
       def t() { fresh { k -> par([1, 2].collect { i -> action { n++ } >> barrier(k, 2) }) } }\n\
       execute t() | t()\n\
       assert { n == 4 }";
    holds "leader: two of one convoy at once, with fresh names"
      "n = 0\n\
       def t(a) { fresh { k -> leader(k, [a >> action { n++ }]) | follower(k, [action { if (n < 1) { halt() } }]) } }\n\
       execute t(p) | t(q)";
    holds "atLeast: so many are done"
      "n = 0\nexecute atLeast(2, [p, q, r].collect { t -> t >> action { n++ } })\nassert { n >= 2 }";
    holds "atLeast: after an error as before"
      ~failures:true ~ends:[ "completed"; broken ]
      "n = 0\n\
       both = atLeast(2, [p, q].collect { t -> t >> action { n++ } })\n\
       execute watch both onError { ignore() }\n\
       n = 0\n\
       execute both\n\
       assert { n == 2 }";
    holds "retrying: so often, and then its error is told" ~failures:true ~ends:[ "completed"; broken ]
      "n = 0\nexecute retrying(3, action { n++ } >> p)\nassert { n <= 3 }";
    holds "retrying: each time that it may" ~failures:true
      ~ends:[ "completed"; broken; "failed: assertion failed" ]
      "n = 0\nexecute retrying(3, action { n++ } >> p)\nassert { n < 3 }";
    holds "barrier: nobody goes on before all are there" ("came = 0\nexecute " ^ meeting);
    holds "follower: after the leader"
      "n = 0\n\
       execute leader('a', [p, q].collect { t -> t >> action { n++ } }) |\n\
      \  follower('a', [action { if (n < 1) { halt() } }, action { if (n < 2) { halt() } }])";
    holds "team: each goal once"
      "n = 0\nexecute team(1, 2, vs, ['p', 'q', 'r']) { g -> imcPlan(g) >> action { n++ } }\nassert { n == 3 }";
    holds "team: goals of who fails are done by others" ~failures:true ~ends:[ "completed"; broken ]
      "n = 0\nexecute team(1, 2, vs, ['p', 'q']) { g -> imcPlan(g) >> action { n++ } }\nassert { n == 2 }";
    holds "team: one may be out, if one is enough" ~failures:true
      ~ends:[ "completed"; broken; "failed: assertion failed" ] (with_failures "team(1, 2");
    holds "team: nobody may be out, if two are needed" ~failures:true ~ends:[ "completed"; broken ]
      (with_failures "team(2, 2");
    holds "near: others only" "assert { near(vs[1], vs, 100.km) == vs[0] + vs[2] && near(vs[1], vs[1], 100.km).size() == 0 }";
    holds "near: only as far as said"
      "d = position(vs[0]).distance(position(vs[1]))\n\
       assert { d > 0 && near(vs[0], vs[1], d) == vs[1] && near(vs[0], vs[1], d / 2).size() == 0 }";
    holds "isBest: the best pair first, of equal ones the oldest"
      "said = []\n\
       for (x in [2, 7, 7, 1]) { post goal: [n: x, of: said.size()]\n said = said + [x] }\n\
       said = []\n\
       def next() { waitFor { consume goal: { isBest('goal', it) { g -> g.n } } } then { g -> action { said = said + [g.of] } } }\n\
       execute repeat 4, next()\n\
       assert { said == [1, 2, 0, 3] }";
    holds "byPriority: each goal is done, also those of vehicles that fail" ~failures:true
      ~ends:[ "completed"; broken ]
      (goals [ 1; 2 ] ^ "execute " ^ inspection "vs.take(2)" ^ "\nassert { !poll('goal') }");
    holds "byPriority: one that comes later is done, too, whether a plan is stopped for it or not"
      (goals [ 1; 2 ] ^ "execute (" ^ inspection "vs.take(2)" ^ " >> condition { poll(late: _) } >> " ^ inspection "vs[0]"
       ^ ") | action { post goal: 3, late: true }\nassert { !poll('goal') }");
    holds "byPriority: none is begun while a more urgent one is there"
      (goals [ 1; 2; 1 ]
       ^ "def make(g) { if (!isBest('goal', g) { it }) fail 'not the best'\n imcPlan { locate g, 2; goTo() } }\n\
          execute byPriority(vs.take(2), 'goal', { it }) { g -> make(g) }");
    holds "byPriority: a goal without a plan is an error of all vehicles" ~ends:[ "failed: no plan" ]
      (goals [ 1 ] ^ "execute byPriority(vs.take(2), 'goal', { it }) { g -> fail 'no plan' }");
    holds "byPriority: a plan whose way is not known is an error before it starts"
      ~ends:[ "failed: the rest of plan 'p' is not known: only its vehicle knows its way" ]
      (goals [ 1 ] ^ "execute byPriority(vs.take(2), 'goal', { it }) { g -> p }");
    holds "byPriority: what has no urgency is left alone, also if it comes later"
      "post goal: [at: 3], goal: [at: 1, urgency: 1]\n\
       def inspect(g) { imcPlan { locate g.at, 2; goTo() } }\n\
       execute byPriority(vs.take(2), 'goal', { it.urgency }) { g -> inspect(g) } | action { post goal: [at: 2] }\n\
       assert { count(goal: _) == 2 && poll(goal: { it.at == 2 }) && poll(goal: { it.at == 3 }) }";
    holds "byPriority: goals that are not maps, or without a number, are left alone"
      "post goal: 'quay', goal: 3, goal: [at: 3, urgency: 'high'], goal: [at: 1, urgency: 1]\n\
       def inspect(g) { imcPlan { locate g.at, 2; goTo() } }\n\
       def urgency(g) { isMap(g) ? g.urgency : null }\n\
       execute byPriority(vs.take(2), 'goal', { urgency(it) }) { g -> inspect(g) } | action { post goal: [1, 2] }\n\
       assert { count(goal: _) == 4 && !poll(goal: { isMap(it) && it.at == 1 }) }";
    holds "isBest: values that are not numbers do not count"
      "post goal: 'a', goal: 2, goal: [7], goal: 1\n\
       execute waitFor { consume goal: { isBest('goal', it) { g -> g } } } then action { post best: 1 }\n\
       assert { count(goal: _) == 3 && !poll(goal: 2) }";
    holds "byPriority: no vehicle" ~ends:[ "failed: byPriority needs a vehicle" ]
      ("execute " ^ inspection "(vs - vs)");
    nothing "byPriority: leaves nothing" (goals [ 1; 2; 2 ] ^ "execute " ^ inspection "vs.take(2)");
    nothing "race: leaves nothing" "execute race([p, q, r])";
    nothing "race: leaves nothing, cut off" "execute race([p, q]) during 1.minutes";
    nothing "team: leaves nothing, cut off" "execute team(1, 2, vs, [p, q]) { g -> g } during 1.minutes";
    nothing "barrier: leaves nothing" "execute par([p, q].collect { t -> t >> barrier('x', 2) })";
    nothing "team: leaves nothing" "execute team(1, 2, vs, [p, q]) { g -> g }" ]

let unused () =
  let names (p : Core.program) = List.map fst p.functions in
  Alcotest.(check (list string)) "functions" [] (names (compile "message 'x'"));
  Alcotest.(check (list string)) "functions" [ "atLeast"; "par"; "race" ]
    (List.sort compare (names (compile "execute race([p])")))

let () =
  Alcotest.run "prelude"
    [ ("examples", List.map example (Prelude.entries ()));
      ("laws", List.filter_map law (Prelude.entries ()));
      ("weak laws", List.filter_map weak_law (Prelude.entries ()) @ no_weak_laws);
      ("what they say", told_of_themselves);
      ("the file", [ Alcotest.test_case "each is told of" `Quick told; Alcotest.test_case "who is not used" `Quick unused ]) ]
