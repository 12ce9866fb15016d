open Dolphin_syntax
open Dolphin_semantics
module Environment = Dolphin_environment.Environment
module Faults = Dolphin_environment.Faults
module Scenario_world = Dolphin_environment.Scenario_world
module Generate = Test_support.Generate
module Calls = Test_support.Calls
module Scenario = Dolphin_scenario.Scenario

type t = {
  name : string;
  source : string;
  program : Core.program;
  world : World.t;
  environment : Environment.options;
  plans : string list;
  prompts : string list;
  calls : string list;
}

(* {1 Random programs} *)

(* What the script does after its picks, again and again: for cycles. *)
let for_ever (program : Ast.program) =
  let comes_first (s : Ast.statement) =
    match s.it with Assign { value = { it = Builder _ | Integer _; _ }; _ } -> true | _ -> false
  in
  let first, rest = List.partition comes_first program in
  first @ [ { it = Ast.While (Generate.expression (Boolean true), rest); at = Location.none } ]

let answering = { Environment.default with answers = (fun _ -> [ [ "1"; "2" ]; [ "0" ] ]); replies = Calls.replies }

let with_losses losses = { answering with losses }
let with_latecomers latecomers = { answering with latecomers }

let all_once =
  { (Environment.failing ~failures:1 answering) with losses = At_most 1; latecomers = At_most 1 }

let interrupted environment : Environment.options = { environment with interruptions = true }

let environments =
  [ ("as planned", answering);
    ("with failures", Environment.failing answering);
    ("with a failure", Environment.failing ~failures:1 answering);
    ("with losses", with_losses Any_number);
    ("with a loss", with_losses (At_most 1));
    ("with latecomers", with_latecomers Any_number);
    ("with all faults once", all_once);
    ("with interruptions", interrupted answering) ]

let of_generated name world environment ast =
  { name; source = Generate.print ast; program = Generate.compile ast; world; environment; plans = [];
    prompts = [ "how many?" ]; calls = Calls.names }

let generated title programs world ~seed n =
  let rand = Random.State.make [| seed |] in
  let one i =
    let calling = i mod 3 = 2 in
    let ast = QCheck2.Gen.generate1 ~rand (if calling then Calls.within programs else programs) in
    let looped = QCheck2.Gen.(generate1 ~rand (frequencyl [ (3, false); (1, true) ])) in
    let kind, environment = List.nth environments (i mod List.length environments) in
    let also is_so what = if is_so then ", " ^ what else "" in
    let name =
      Printf.sprintf "%s %d, %s%s%s" title (i + 1) kind (also calling "with calls") (also looped "for ever")
    in
    of_generated name world environment (if looped then for_ever ast else ast)
  in
  List.init n one

let random = generated "random" Generate.program Generate.world
let sensing = generated "with sensors" Generate.sensing_program Generate.open_world

(* {1 Examples} *)

let read path =
  let channel = open_in_bin path in
  Fun.protect ~finally:(fun () -> close_in channel) (fun () -> really_input_string channel (in_channel_length channel))

let compiled path source =
  let explain ds = Format.asprintf "%a" (Fmt.list (Diagnostic.pp ~source)) ds in
  let result =
    Result.bind (Parse.program ~file:path source) (fun ast -> Elaborate.program ~source_name:path ast)
  in
  match result with Ok (program, _) -> program | Error ds -> failwith (explain ds)

let scenario_beside path =
  let fleet = Scenario.beside path in
  if not (Sys.file_exists fleet) then Scenario.default
  else
    match Scenario.read ~file:fleet (read fleet) with
    | Ok scenario -> scenario
    | Error ds -> failwith (Format.asprintf "%a" (Fmt.list (Diagnostic.pp ~source:(read fleet))) ds)

let in_scenario name source program (scenario : Scenario.t) faults =
  { name; source; program; world = Scenario_world.world scenario;
    environment = Scenario_world.environment ~answers:[] ~faults scenario;
    plans = List.map (fun (p : Scenario.plan) -> p.name) scenario.plans;
    prompts = List.map (fun (a : Scenario.answer) -> a.prompt) scenario.answers;
    calls = List.map (fun (r : Scenario.reply) -> r.call) scenario.replies }

let example directory kinds file =
  let path = Filename.concat directory file in
  let source = read path in
  let program = compiled path source and scenario = scenario_beside path in
  List.map (fun (kind, faults) -> in_scenario (file ^ kind) source program scenario faults) kinds

let examples_with kinds directory =
  let files = List.filter (fun f -> Filename.check_suffix f ".dol") (Array.to_list (Sys.readdir directory)) in
  List.concat_map (example directory kinds) (List.sort compare files)

let examples =
  examples_with [ ("", Faults.none); (", with failures", { Faults.none with fail = Any_number }) ]

(* Of a supplier whose every call may fail. *)
let unreliably_supplied c =
  let replies call = List.map (fun round -> round @ [ Error "nobody is there" ]) (c.environment.replies call) in
  if c.calls = [] then None
  else Some { c with name = c.name ^ ", with calls that fail"; environment = { c.environment with replies } }

let faulty_examples directory =
  List.filter_map unreliably_supplied (examples_with [ ("", Faults.none) ] directory)
  @ examples_with
    [ (", with losses", { Faults.none with loss = Any_number });
      (", with a latecomer", { Faults.none with join = At_most 1 });
      (", with all faults once", { Faults.none with fail = At_most 1; loss = At_most 1; join = At_most 1 });
      (", with interruptions", { Faults.none with interrupt = true });
      (", with a failure and interruptions", { Faults.none with fail = At_most 1; interrupt = true }) ]
    directory

(* {1 Traps} *)

let trap ?failures ?(world = Generate.world) name source =
  let name = "trap: " ^ name in
  let environment = Environment.failing ?failures answering in
  { name; source; program = compiled "trap.dol" source; world; environment; plans = [];
    prompts = [ "how many?" ]; calls = Calls.names }

let two = "a = pick { id 'a' }; b = pick { id 'b' }\n"

let of_tasks =
  trap "at most one failure" ~failures:1 (two ^ "execute watch (task('p')[a] >> task('q')[b]) onError { ignore() }\nexecute task('p')[a]")
  :: List.map
    (fun (name, source) -> trap name source)
    [ ("vehicles that a failure stops are free again",
       two ^ "execute (watch (task('p')[a] | task('q')[b]) onError { ignore() }) >> (task('q')[a] | task('p')[b])");
      ("a fault of an until's condition stops vehicles",
       two ^ "execute watch (until { 1 / 0 > 1 } run task('p')[a]) onError { ignore() }");
      ("a guard does not take a part", "post x: 1\nexecute condition { consume x: 1, y: 1 } | action { post y: 1 } >> condition { consume x: 1 }");
      ("code that breaks leaves nothing", "x = 0\nexecute watch (action { post k: 1; x = 1; y = 1 / 0 }) onError { ignore() }\nif (poll(k: 1) || x == 1) { message 'left' }");
      ("a handler that breaks leaves nothing", two ^ "execute watch (watch task('p')[a] onError { post k: 1; 1 / 0 }) onError { ignore() }\nif (poll(k: 1)) { message 'left' }");
      ("a guard that is false did nothing", "post k: 1\nexecute condition { consume k: 1; false } | condition { poll k: 1 }");
      ("until stops what runs, or what did not start", two ^ "execute (until { poll x: 1 } run (task('p')[a] >> task('q')[a])) | action { post x: 1 }");
      ("an error leaves out what would follow", two ^ "execute watch (task('p')[a] >> task('q')[b] >> task('q')[a]) onError { ignore() }");
      ("a handler that does nothing propagates", two ^ "execute watch task('p')[a] onError { post k: 1 }");
      ("a condition that breaks", "execute watch condition { 1 / 0 } onError { ignore() }");
      ("a guard that breaks", "execute watch (oneOf { when { 1 / 0 } then idle(1.seconds) }) onError { ignore() }");
      ("a script that breaks", "x = 1\npost k: x\nx / 0");
      ("a script that computes for long", "x = 0\nwhile (x < 2000) { x = x + 1 }\npost k: x");
      ("the oldest pair", "post k: 1\npost k: 2\nexecute condition { consume k: _ } >> condition { consume k: 2 }");
      ("a pair twice is there twice", "post k: 1\npost k: 1\nexecute condition { consume k: 1 } >> condition { consume k: 1 }");
      ("a handler's deeds", two ^ "execute watch task('p')[a] onError { post failed: 1; ignore() }\nif (consume(failed: 1)) { message 'seen' }");
      ("a handler's halt", two ^ "execute (watch task('p')[a] onError { halt 'enough' }) | task('q')[b]");
      ("three branches, one at a time", two ^ "execute allOf { when { true } then task('p')[a] \n when { true } then task('q')[b] \n when { poll x: 1 } then action { post y: 1 } } | action { post x: 1 }");
      ("a timer that is not needed any more", two ^ "execute (during 10.seconds run task('p')[a]) >> idle(5.seconds)");
      ("code that says how long", "execute during { post asked: 1; 3 } run condition { consume asked: 1 }");
      ("released, and picked again", two ^ "release a\nc = pick { id 'a' }\nexecute task('p')[c] | task('q')[b]");
      ("which two of three", "v = pick { count 2 }\nexecute task('p') | task('q')");
      ("not enough for all", "v = pick { id 'a' }\nexecute task('p') | task('q')");
      ("an assertion that no watch sees", two ^ "execute watch (assert({ poll x: 1 }, 'x is there') | action { post x: 1 } | task('p')[a]) onError { ignore() }") ]

(* In a world where the batteries of a and c may show anything, b's 1 or 0.2, and c is in one of two places. *)
let sensor_traps =
  let one ?(world = Generate.open_world) (name, source) = trap ~world ("sensors: " ^ name) source in
  let three = two ^ "c = pick { id 'c' }\n" and low = "battery(a) < 0.3" and charged = "battery(a) >= 0.3" in
  List.map (fun case -> one case)
    [ ("a guard", two ^ "execute (waitFor { " ^ low ^ " } then task('p')[a]) | task('q')[b]");
      ("until", two ^ "execute (task('p')[a] / { " ^ low ^ " }) | condition { " ^ charged ^ " }");
      ("an assertion", two ^ "execute task('p')[a] | assert({ battery(a) > 0.1 }, 'low')");
      ("a time", two ^ "execute during { " ^ low ^ " ? 5 : 10 } run task('p')[a]");
      ("one battery against another", three ^ "message battery(a) < battery(c)\nmessage (battery(a) < battery(b) && battery(c) > battery(a))");
      ("of two batteries one is low", three ^ "if (" ^ low ^ " && battery(c) >= 0.3) { halt 'a is low' }");
      ("the same comparison again", two ^ "message ((" ^ low ^ ") == (" ^ low ^ "))");
      ("a comparison and its opposite", two ^ "message (" ^ low ^ " && " ^ charged ^ ")");
      ("the same at another step", two ^ "execute condition { " ^ low ^ " } >> condition { " ^ charged ^ " }");
      ("kept, and compared later", two ^ "h = battery(a)\npost x: 1\nif (h < 0.3 && " ^ charged ^ ") { halt 'charged' }");
      ("kept twice", two ^ "h = battery(a)\npost x: 1\ni = battery(a)\npost x: 1\nif (h < 0.3 && i >= 0.3) { halt h }");
      ("kept by a task", two ^ "h = 1\nexecute (action { h = battery(a) }) >> condition { h < 0.3 && " ^ charged ^ " }");
      ("kept by a local", two ^ "def f(l) { post x: 1; return l < 0.3 && " ^ charged ^ " }\nif (f(battery(a))) { halt 'charged' }");
      ("kept by a caller", two ^ "def g() { post x: 1; return 1 }\ndef f(l) { y = g(); message l; return y }\nmessage f(battery(a)) + 1");
      ("kept by an argument", two ^ "def f(l, x, m) { message l; return l < m && " ^ charged ^ " }\npost x: 1\nif (f(battery(a), consume(x: 1), 0.3)) { halt 'charged' }");
      ("told of", two ^ "message \"${(battery(a) * 100 - 1).round()} percent\"\nmessage 'at ' + position(a)\nmessage(-battery(a))");
      ("computed with", two ^ "message Math.max(battery(a), 0.5) > 0.7 && position(a).distance(Location.APDL) / 2 < 100 && Location.APDL in (position(a) ^ 10)");
      ("equal", two ^ "message battery(a) == 1\nmessage battery(a) != 'x'\nmessage position(a).equals(Location.APDL)");
      ("in an area", two ^ "execute waitFor { position(a) in (Location.APDL ^ 150) || position(b) in (Location.APDL ^ 150) } then task('p')[a]");
      ("outcomes that are one", two ^ "execute action { if (" ^ low ^ ") { post x: 1 } else { post x: 1 } }\nif (" ^ low ^ ") { post y: 1 } else { post y: 1 }");
      ("one outcome, by two rules", two ^ "execute watch (watch task('p')[a] onError { if (" ^ low ^ ") { ignore() } }) onError { ignore() }");
      ("a handler sees what the code saw", two ^ "execute watch (action { if (" ^ low ^ ") { 1 / 0 } else { 2 / 0 } }) onError { if (" ^ low ^ ") { post x: 1; ignore() } }");
      ("a handler sees what another one saw", two ^ "execute watch (watch task('p')[a] onError { if (" ^ low ^ ") { post x: 1 } }) onError { if (" ^ charged ^ ") { ignore() } }");
      ("kept by one handler, and compared by another", two ^ "h = battery(a)\nexecute watch (watch task('p')[a] onError { if (h < 0.3) { post low: 1; h = battery(a) } }) onError { if (h >= 0.3) { post high: 1 } ; ignore() }");
      ("a loop that looks again and again", two ^ "while (battery(a) >= 0.3) { pause 5 }");
      ("one of several values", two ^ "message battery(b)\nif (battery(b) == 1 && battery(b) < 0.3) { halt 'both' }\nmessage battery(b)");
      ("several values of two sensors", three ^ "if (battery(b) < 0.3) { message position(c) in (Location.APDL ^ 1.km) }");
      ("picked where it is seen", "v = pick { id 'c'; region Location.APDL, 1.km }\nrelease v\nv = pick { id 'c'; region Location.APDL, 1.km }");
      ("beside one that is bound", "c = pick { id 'c' }\nv = pick { count _; region Location.APDL, 1.km }\nw = pick { id 'c'; region Location.APDL, 1.km }");
      ("all that are seen there", "v = pick { count _; region Location.APDL, 1.km }");
      ("picked in a place, and seen in another one", "v = pick { id 'c'; region Location.APDL, 1.km }\nmessage position(v)");
      ("the nearer one", three ^ "t = imcPlan { planName 'q'\n locate 41.2032, -8.7048\n goTo() }\nexecute t\nexecute t | t");
      ("the nearer one, as was seen in this step", three ^ "if (position(c) in (Location.APDL ^ 1.km)) {\nexecute imcPlan { planName 'q'\n locate 41.2032, -8.7048\n goTo() }\n}") ]
  @ [ one ~world:(World.open_position "c" [] Generate.open_world)
        ("coordinates", two ^ "if (position(a).latitude > 41 && position(a).bearing(Location.APDL) < 90) { message position(a).longitude - 1 }");
      { (trap ~world:Generate.open_world "sensors: an answer" "a = pick { id 'a' }\nh = ask 'how many?'\npost x: 1\nif (h < 0.3 && battery(a) >= 0.3) { halt h }\nmessage ask('how many?') < 0.3 && battery(a) < 0.3")
        with prompts = [ "how many?" ];
             environment = { answering with answers = (fun _ -> [ [ "battery(a)" ]; [ "battery(a) < 0.3 ? battery(a) : 1 / 0"; "1 / 0" ] ]) } } ]

let supplied = "s = getSupplier()\n"

(* Calls of the supplier that [Calls] stands in for. *)
let calls =
  List.map
    (fun (name, source) -> trap name (supplied ^ source))
    [ ("replies that differ from one call to the next", "x = s.level\ny = s.level\nz = s.level\npost k: y");
      ("a call for which there is no reply", two ^ "x = s.level\ny = s.nothing(x)");
      ("a reply that fails the second time", two ^ "s.next()\nexecute s.next()");
      ("replies of two objects", "t = s.self\nx = s.level + t.level\nt = s.self\nx = t.level");
      ("what a host object is", "t = s.self\nif (s == t) { post same: t } else { post other: t }\nm = [a: s, b: [t]]\n\
                                 if (s && s in m.b) { message \"${m} ${s}\" }\nconsume other: t\nmessage s[0]");
      ("what a host object is not", "x = s + 1");
      ("methods of an object with names of the language", "s.add(1)\nmessage s\ns.ready()\nmessage s.size()");
      ("calls that differ in their arguments", "x = s.level(ask 'how many?', [s])");
      ("calls in code of tasks",
       two
       ^ "t = watch action { post x: 1; y = s.level } onError { e -> message e; ignore() }\n\
          execute t >> watch condition { s.ready(1) } onError { e -> message e; ignore() }");
      ("tasks of a supplier, executed twice",
       two ^ "t = s.next()\nexecute watch (t[a] | t[b]) onError { ignore() }\nexecute t >> s.self.next()");
      ("an object in a closure", "f = { s.level }\nx = f() + f()\nexecute watch action { f() } onError { ignore() }");
      ("asked again and again", "while (s.ready()) { message 'on' }") ]

(* Programs at rest in each way in which they can wait, and at work. *)
let interruptions =
  let programs =
    [ ("interrupted while vehicles run",
       two ^ "post k: 1\nexecute (task('p')[a] >> task('q')[a]) | task('q')[b] | idle(5.seconds)");
      ("interrupted while it waits",
       "v = pick { count _ }\nx = ask 'how many?'\npause 3.seconds\n" ^ supplied ^ "post k: s.level\nrelease v");
      ("interrupted where it is stuck", "v = pick { id 'a' }\nexecute condition { consume k: 1 }");
      ("interrupted within an until, and a handler",
       two
       ^ "t = until { poll x: 1 } run (task('p')[a] | during 2.seconds run task('q')[b])\n\
          execute watch t onError { post x: 1; ignore() }");
      ("interrupted again and again", "while (true) { post k: 1; consume k: 1 }") ]
  in
  let kinds = [ ("", interrupted answering); (", with all faults once", interrupted all_once) ] in
  let one (name, source) (kind, environment) = { (trap (name ^ kind) source) with environment } in
  List.concat_map (fun program -> List.map (one program) kinds) programs

let questions =
  let asking name answers source = { (trap name source) with environment = { answering with answers } } in
  [ asking "a question that nobody answers" (fun _ -> []) "x = ask 'how many?'";
    asking "answers that are refused" (fun _ -> [ [ "y"; "1 / 0" ]; [ "2"; "post(k: 1)" ] ]) "x = ask 'how many?'" ]

let traps = of_tasks @ questions @ calls @ interruptions @ sensor_traps

let lost_once = "v = pick { id 'a' }\nt = watch task('p')[v] onError { post failed: 1; ignore() }\nexecute t\n"

(* Each with losses and with vehicles that are late, with and without bounds. *)
let faulty_traps =
  let programs =
    [ ("a lost vehicle may be lost again, and that is no other loss", lost_once ^ "execute t\nexecute t");
      ("nothing is heard of a lost vehicle when another one is picked", lost_once ^ "w = pick { id 'b' }\nexecute t");
      ("of two vehicles, one after the other", two ^ "execute watch (task('p')[a] | task('q')[b]) onError { ignore() }\nexecute task('q')[b] >> task('p')[a]");
      ("a lost vehicle is missing, or is there", lost_once ^ "release v\nw = pick { id 'a'; timeout 1.seconds }\nexecute t");
      ("all, less who is lost", lost_once ^ "release v\nw = pick { count _ }");
      ("two, less who is lost", lost_once ^ "release v\nw = pick { count 2 }");
      ("late for two picks", "v = pick { count 2; type 'UUV' }\nrelease v\nw = pick { count _ }");
      ("late in a place", "v = pick { region Location.APDL, 150 }\nw = pick { count _; region Location.APDL, 150; timeout 0.seconds }") ]
  in
  let kinds =
    [ ("with losses", with_losses Any_number); ("with a loss", with_losses (At_most 1));
      ("with latecomers", with_latecomers Any_number); ("with all faults once", all_once) ]
  in
  let one (name, source) (kind, environment) =
    { (trap (name ^ ", " ^ kind) source) with environment }
  in
  List.concat_map (fun program -> List.map (one program) kinds) programs
