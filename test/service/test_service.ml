open Dolphin_service
module Builtins = Dolphin_semantics.Builtins

let read source = Service.read ~file:"m.dol" source

(* The program, with the offset of the mark [#] in it, which is taken out. *)
let split text =
  let at = String.index text '#' in
  String.sub text 0 at ^ String.sub text (at + 1) (String.length text - at - 1), at

let marked text =
  let source, at = split text in
  read source, at

let texts d spans =
  List.map (fun ({ start; stop } : Service.span) -> String.sub (Service.source d) start (stop - start)) spans

let case name f = Alcotest.test_case name `Quick f
let strings = Alcotest.(list string)
let ints = Alcotest.(list int)

(* {1 Places} *)

let positions () =
  let text = "a\xF0\x9F\x90\xACb\n\xC3\xA9x" in
  let back n = Text_position.to_offset text (Text_position.of_offset text n) in
  Alcotest.(check ints) "characters" [ 0; 1; 5; 6; 7; 9; 10 ] (List.map back [ 0; 1; 5; 6; 7; 9; 10 ]);
  Alcotest.(check int) "UTF-16" 3 (Text_position.of_offset text 5).character;
  Alcotest.(check int) "beyond a line" 6 (Text_position.to_offset text { line = 0; character = 99 });
  Alcotest.(check int) "beyond the text" 10 (Text_position.to_offset text { line = 9; character = 0 })

(* {1 Names} *)

let references text expected () =
  let d, at = marked text in
  Alcotest.(check ints) text expected (List.map (fun (s : Service.span) -> s.start) (Service.references d at))

let rename text x expected () =
  let d, at = marked text in
  let found =
    match Service.rename d at x with
    | Ok spans -> "Ok " ^ String.concat " " (List.map (fun (s : Service.span) -> string_of_int s.start) spans)
    | Error why -> why in
  Alcotest.(check string) text expected found

let names =
  [ case "a local hides a global" (references "x = 1\nif (x) { def #x = 2; message x }\nmessage x" [ 19; 34 ]);
    case "a global" (references "#x = 1\nif (x) { def x = 2; message x }\nmessage x" [ 0; 10; 46 ]);
    case "a function may come later" (references "message #f(1)\ndef f(n) { n }" [ 17; 8 ]);
    case "a parameter" (references "def f(n) { #n + n }" [ 6; 11; 15 ]);
    case "a closure's parameter" (references "x = [1].collect { y -> #y + 1 }" [ 18; 23 ]);
    case "vehicles of execute" (references "#v = pick { type 'UUV' }\nexecute v: imcPlan('a')" [ 0; 32 ]);
    case "a setting is no variable" (references "#count = 2\nv = pick { count count }" [ 0; 27 ]);
    case "a hole of a string" (references "#x = 1\nmessage \"a ${x} $x\"" [ 0; 19; 23 ]);
    case "a procedure's name as a variable" (references "#battery = battery(v)\nmessage battery" [ 0; 29 ]);
    case "in parentheses" (references "#x = 1\ny = (x) + ((x))" [ 0; 11; 18 ]);
    case "nothing" (references "message # 1" []);
    case "renaming" (rename "#x = 1\nmessage x" "y" "Ok 0 14");
    case "into a name that is there" (rename "#x = 1\ny = x" "y" "the name 'y' is taken: the program would mean something else");
    case "into one that would be captured" (rename "#x = 1\nf = { y -> x + y }" "y" "the name 'y' is taken: the program would mean something else");
    case "into a word" (rename "#x = 1" "while" "'while' is not a name") ]

(* {1 Completion} *)

let completes ?(absent = []) text present () =
  let d, at = marked text in
  let labels = List.map (fun (i : Service.item) -> i.label) (snd (Service.complete d at)) in
  List.iter (fun x -> Alcotest.(check bool) (x ^ " in " ^ text) true (List.mem x labels)) present;
  List.iter (fun x -> Alcotest.(check bool) (x ^ " not in " ^ text) false (List.mem x labels)) absent

let completion =
  [ case "names" (completes "boats = pick { }\nexe#" [ "execute"; "boats"; "imcPlan"; "while" ]);
    case "in a text that is no program" (completes "def tow(x) {\n  execute (\n  #" [ "tow"; "execute" ]);
    case "settings" (completes "v = pick {\n  ty#" [ "type"; "payload"; "region" ]);
    case "maneuvers" (completes "p = imcPlan { speed 1; # }" [ "goTo"; "loiter"; "locate" ]);
    case "their arguments" (completes "p = imcPlan { loiter # }" [ "radius"; "duration" ] ~absent:[ "goTo" ]);
    case "items of missions" (completes "p = mission { speed 1; # }" [ "goPos"; "takeOff"; "name" ] ~absent:[ "loiter"; "z" ]);
    case "their arguments" (completes "p = mission { loiterTurns # }" [ "radius"; "turns" ] ~absent:[ "goPos" ]);
    case "a new line is a new statement" (completes "p = imcPlan {\n  loiter radius: 2\n  #" [ "goTo" ] ~absent:[ "radius" ]);
    case "but not after a comma" (completes "p = imcPlan {\n  loiter radius: 2,\n  #" [ "duration" ] ~absent:[ "goTo" ]);
    case "units" (completes "pause 2.#" [ "km"; "minutes" ] ~absent:[ "execute" ]);
    case "constants" (completes "x = Location.#" [ "APDL" ]);
    case "constants of two points" (completes "x = Speed.Units.R#" [ "RPM" ]);
    case "members" (completes "x = [1].#" [ "size"; "collect" ] ~absent:[ "execute" ]);
    case "not in comments" (completes "x = 1 // exe #" [] ~absent:[ "execute" ]) ]

(* {1 Calls, and other files} *)

let called ?(file = "m.dol") text form () =
  let source, at = split text in
  let found = Service.signature (Service.read ~file source) at in
  Alcotest.(check (option string)) text form (Option.map (fun (i : Service.item) -> i.form) found)

(* A program of two files, beside this test. *)
let with_library f =
  let path = Filename.temp_file "service" ".dol" in
  let write path text =
    let channel = open_out path in
    output_string channel text;
    close_out channel
  in
  write path "// Shared.\ndef tow(boat, metres) { message boat }\n";
  Fun.protect ~finally:(fun () -> Sys.remove path) (fun () ->
      f ~file:(Filename.concat (Filename.dirname path) "m.dol") ~library:path)

let of_library text form () =
  with_library (fun ~file ~library ->
      called ~file (Printf.sprintf "include '%s'\n%s" (Filename.basename library) text) form ())

let defined_elsewhere () =
  with_library (fun ~file ~library ->
      let source, at = split (Printf.sprintf "include '%s'\nto#w('a', 2)\n" (Filename.basename library)) in
      match Service.definition (Service.read ~file source) at with
      | Some { file; source; span } ->
        Alcotest.(check string) "the file" library file;
        Alcotest.(check string) "the name" "tow" (String.sub source span.start (span.stop - span.start))
      | None -> Alcotest.fail "it is defined in the other file")

let calls =
  [ case "a function of the program" (called "def tow(boat, n) { n }\ntow('a', #" (Some "tow(boat, n)"));
    case "of a file that it includes" (of_library "x = tow('a', #" (Some "tow(boat, metres)"));
    case "not where nothing is called" (called "x = 1\n#" None);
    case "not in comments" (called "message 1 // message #" None);
    case "a procedure" (fun () ->
        let source, at = split "message #" in
        Alcotest.(check bool) "known" true (Service.signature (Service.read ~file:"m.dol" source) at <> None));
    case "definitions in other files" defined_elsewhere ]

(* {1 The reference} *)

(* Each name of the language has an entry: lib/service/vocabulary.ml. *)
let documented () =
  let missing kind names entries =
    let known = List.map (fun (e : Vocabulary.entry) -> e.name) entries in
    List.filter_map (fun x -> if List.mem x known then None else Some (kind ^ " " ^ x)) names in
  let builders : Dolphin_syntax.Ast.builder list = [ Pick; Imc_plan; Pos ] in
  Alcotest.(check strings) "without an entry" []
    (missing "word" Dolphin_syntax.Cursor_context.words Vocabulary.words
     @ missing "procedure" Builtins.names Vocabulary.procedures
     @ missing "block" Builtins.builder_names Vocabulary.blocks
     @ List.concat_map (fun b -> missing "setting" (Builtins.settings b) (Vocabulary.settings b)) builders
     @ missing "setting of a vehicle" Dolphin_scenario.Fleet_parser.vehicle_settings (Vocabulary.fleet_settings "vehicle")
     @ missing "setting of a plan" Dolphin_scenario.Fleet_parser.plan_settings (Vocabulary.fleet_settings "plan"))

(* {1 Allocations} *)

let fleet = { Service.path = "m.fleet"; text = "vehicle 'a', { type 'UUV' }\nvehicle 'b', { type 'UUV' }\n" }

(* "vehicles: the task", for each hint. *)
let hints ?fleet text expected () =
  let hint (at, vehicles) =
    String.concat ", " vehicles ^ ": " ^ List.hd (String.split_on_char ')' (String.sub text at (String.length text - at))) in
  let d = Service.read ~file:"m.dol" ?fleet text in
  Alcotest.(check strings) text expected (List.map hint (Service.allocations d))

let team = "v = pick { count 2; type 'UUV' }\n"

let allocations =
  [ case "side by side" (hints ~fleet (team ^ "execute task('s') | task('t')") [ "a: task('s'"; "b: task('t'" ]);
    case "one after the other"
      (hints ~fleet (team ^ "w = v[1]\nexecute w: task('s') >> task('t')") [ "b: task('s'"; "b: task('t'" ]);
    case "in a loop" (hints ~fleet (team ^ "for (x in v) { execute x: task('s') }") [ "a, b: task('s'" ]);
    case "what is not reached" (hints ~fleet (team ^ "if (false) { execute task('s') }") []);
    case "without an end" (hints ~fleet (team ^ "execute repeat task('s')") [ "a: task('s'" ]);
    case "nothing to pick" (hints ~fleet "v = pick { type 'UAV' }\nexecute task('s')" []);
    case "no fleet" (hints (team ^ "execute task('s')") []);
    case "a fault" (hints ~fleet (team ^ "execute task('s') | x") []) ]

(* {1 The prelude} *)

let prelude () =
  let labels text =
    let d, at = marked text in
    List.map (fun (i : Service.item) -> i.label) (snd (Service.complete d at)) in
  let with_it = "include 'prelude'\nexecute ra#" and without = "message 1\nexecute ra#" in
  Alcotest.(check (list bool)) "completed where it is included" [ true; false ]
    [ List.mem "race" (labels with_it); List.mem "race" (labels without) ];
  let d, at = marked "include \"prelude\"\nexecute ra#ce([task('p')])" in
  let told = match Service.hover d at with Some (_, text) -> text | None -> "" in
  Alcotest.(check string) "hover" "```dolphin\nrace(tasks)\n```" (String.sub told 0 (min 26 (String.length told)))

(* {1 Everything, everywhere} *)

let read_file path =
  let channel = open_in_bin path in
  let text = really_input_string channel (in_channel_length channel) in
  close_in channel;
  text

(* The words of the language are in the files by which editors highlight it. *)
let highlighted () =
  let is_letter c = match c with 'a' .. 'z' | 'A' .. 'Z' | '0' .. '9' | '_' -> true | _ -> false in
  let words text = String.split_on_char ' ' (String.map (fun c -> if is_letter c then c else ' ') text) in
  let missing path =
    let known = words (read_file path) in
    List.filter_map
      (fun x -> if List.mem x known then None else Some (path ^ " lacks " ^ x))
      (Dolphin_syntax.Cursor_context.words @ Builtins.names @ Builtins.builder_names) in
  Alcotest.(check strings) "lacking" []
    (List.concat_map missing
       [ "../../editors/vim/syntax/dolphin.vim"; "../../editors/vscode/syntaxes/dolphin.tmLanguage.json" ])

let examples =
  let folders = [ "../../examples"; "../../examples/missions"; "../../examples/related" ] in
  let files folder = List.map (Filename.concat folder) (List.sort compare (Array.to_list (Sys.readdir folder))) in
  let is_source path = Filename.check_suffix path ".dol" || Filename.check_suffix path ".fleet" in
  List.map read_file (List.filter is_source (List.concat_map files folders))

(* Any query about any part of a program is answered; every name that occurs is found from its place. *)
let answered (text, (length, at)) =
  let text = String.sub text 0 (length mod (String.length text + 1)) in
  let d = Service.read ~file:"m.dol" ~fleet text in
  let at = at mod (String.length text + 1) in
  ignore (Service.diagnostics d, Service.complete d at, Service.hover d at, Service.definition d at);
  ignore (Service.signature d at, Service.symbols d);
  ignore (Service.allocations d);
  let uses = Service.references d at in
  List.length (List.sort_uniq compare (texts d uses)) <= 1
  && List.for_all (fun (s : Service.span) -> Service.references d s.start = uses) uses

let anywhere =
  let open QCheck2.Gen in
  Test_support.Property.case "any part of any example" ~count:300
    ~print:(fun (text, (length, at)) -> Printf.sprintf "%d of %d:\n%s" at length text)
    (pair (oneofl examples) (pair (int_bound 5000) (int_bound 5000)))
    answered

(* {1 Diagnostics} *)

let reported ?fleet source =
  let fleet = Option.map (fun text : Service.fleet -> { path = "m.fleet"; text }) fleet in
  let show (d : Dolphin_syntax.Diagnostic.t) =
    let kind = match d.severity with Error -> "error" | Warning -> "warning" in
    Printf.sprintf "%d: %s: %s" (Dolphin_syntax.Location.line d.at) kind d.message in
  List.map show (Service.diagnostics (Service.read ~file:"m.dol" ?fleet source))

let diagnoses ?fleet source expected () = Alcotest.(check strings) source expected (reported ?fleet source)

let of_prelude call expected =
  case call (diagnoses ("include 'prelude'\nv = pick { type 'UUV'; count 2 }\nn = 2\nexecute " ^ call) expected)

let preludes =
  [ of_prelude "seq(task('a') >> task('b'))" [ "4: error: seq takes a list here, this is a task" ];
    of_prelude "forall(v, task('a'))" [ "4: error: forall takes code { ... } here, this is a task" ];
    of_prelude "every(task('a'), 5.min)"
      [ "4: error: every takes a number here, this is a task"; "4: error: every takes a task here, this is a number" ];
    of_prelude "barrier(2, 'meet')"
      [ "4: error: barrier takes a string here, this is a number";
        "4: error: barrier takes a number here, this is a string" ];
    of_prelude "team(1, 2, v, 'a') { g -> task(g) }" [ "4: error: team takes a list here, this is a string" ];
    of_prelude "race([task('a'), retrying(n, { task('b') })]) >> every(5.min, { task('c') })" [];
    of_prelude "team(1, n, v, v) { g -> task('d') } >> patrol([task('a')] + [task('b')])" [] ]

let two = "vehicle 'a', { type 'UUV' }\nvehicle 'b', { type 'UUV' }\n"

let foreseen =
  let case name ?(fleet = two) source expected = case name (diagnoses ~fleet source expected) in
  [ case "a plan at the fleet's place" ~fleet:("locate 41.18, -8.70\n" ^ two)
      "v = pick { id 'a' }\nexecute imcPlan { planName 'stay'; skeeping duration: 1.min }" [];
    case "code of every run" "xs = [1, 2]\nmessage xs[2]" [ "2: error: index 2 is out of range: a list has 2 elements" ];
    case "by way of a function and a loop" "def f(x) { x / (2 - x) }\nfor (i in 1..3) { post k: f(i) }"
      [ "1: error: division by zero" ];
    case "a task without vehicles" "execute task('a')"
      [ "1: error: no vehicle can run task 'a': no vehicle is bound to the program: pick one first" ];
    case "after a pick" "v = pick { type 'UUV' }\nm = [x: 1]\nexecute task('a')\nn = m[v.id] * 2"
      [ "4: warning: a run ends here: * takes two numbers, not null and a number" ];
    case "vehicles that the fleet does not have" "v = pick { type 'UUV'; count 3 }"
      [ "1: warning: a run ends here: could not pick 3 vehicles of type 'UUV': a fits; b fits" ];
    case "tasks after a release" "v = pick { type 'UUV' }\nrelease v\nexecute v: task('a')"
      [ "3: warning: a run ends here: no vehicle can run task 'a': no vehicle is bound to the program: pick one first" ];
    case "an assertion" "assert { 1 > 2 }, 'never'" [ "1: error: assertion failed: never" ];
    case "an end that is meant" "fail 'not yet written'" [];
    case "a halt" "v = pick { type 'UUV' }\nhalt 'enough'" [];
    case "a reading decides" "v = pick { type 'UUV' }\nif (battery(v) < 0.5) { xs = []; message xs[1] }" [];
    case "an order decides"
      "v = pick { count 2 }\nn = 0\nexecute task('a') >> action { n = 1 } | task('b') >> action { n = n / n }" [];
    case "an answer decides" ~fleet:(two ^ "answer 'n?', 0, 1\nanswer 'm?', either(0, 1)") "n = ask 'm?'\nx = 1 / n" [];
    case "an endless loop" "while (true) { x = 1 }" [];
    case "a handler" "v = pick { type 'UUV' }\nexecute watch action { x = 1 / 0 } onError { ignore() }" [] ]

let timeless =
  let fleet = two ^ "plan 'long', { duration 2.min }\nplan 'zero', { duration 0 }\n" in
  let goes_round = [ "2: warning: a round of this takes no time: a run that gets here goes round at one instant" ] in
  let fails_again = [ "2: warning: this fails at once, and retry() starts it again at the same instant" ] in
  let case task expected = case task (diagnoses ~fleet ("v = pick { type 'UUV' }\nexecute " ^ task) expected) in
  [ case "repeat { task('zero') }" goes_round;
    case "repeat { return task('zero') }" goes_round;
    case "repeat { task('long') }" [];
    case "repeat (task('long') during 0)" goes_round;
    case "repeat ((task('long') >> idle(1)) during 0.min)" goes_round;
    case "repeat (idle(1) during 0) >> idle(1)" [];
    case "repeat (task('long') during 1)" [];
    case "(repeat task('long')) during 0" [];
    case "repeat (task('long') within 0)" [];
    case "repeat ((condition { poll('x') } >> idle(1)) during 0)" [];
    case "watch (task('long') within 0) onError { retry() }" fails_again;
    case "watch (task('long') within 5) onError { retry() }" [] ]

(* {1 Shapes} *)

(* Each shape as its name, its kind, the text of each movable number, and [fixed] for each fixed point; a number that
   cannot be negative has a plus. *)
let shown d (shape : Map_shapes.t) =
  let number (n : Map_shapes.number) = (if n.negative then "" else "+") ^ List.hd (texts d [ n.span ]) in
  let point (p : Map_shapes.point) =
    match p.coordinates with Some (x, y) -> number x ^ " " ^ number y | None -> "fixed" in
  let kind, points =
    match shape.form with
    | Spot p -> "spot", [ point p ]
    | Way ps -> "way", List.map point ps
    | Plan ps -> "plan", List.map point ps
    | Rings rings -> "rings", List.map (fun ps -> String.concat " / " (List.map point ps)) rings
    | Round { centre; metres; _ } -> "round", point centre :: Option.to_list (Option.map number metres)
    | Computed _ -> "computed", [] in
  String.concat ", " ((shape.name ^ " " ^ kind) :: points)

let shapes source expected () =
  let d = read source in
  Alcotest.(check (list string)) source expected (List.map (shown d) (Result.get_ok (Service.shapes d)))

let shaped =
  let case source expected = case source (shapes source expected) in
  [ case "quay = location 41.185, -8.706" [ "quay spot, +41.185 -8.706" ];
    case "quay = location(41.185, -8.706)" [ "quay spot, 41.185 -8.706" ];
    case "quay = pos { lat 41; lon(-8.5) }" [ "quay spot, +41 -8.5" ];
    case "quay = location(41.185, 8.706.west)" [ "quay spot, fixed" ];
    case "quay = location '41 11 6 N, 8 42 24 W'" [ "quay spot, fixed" ];
    case "x = location(95, 8)" [];
    case "def location(a, b) { a }\nx = location(41, 8)" [];
    case "message 'location(41, 8)' // location(41, 8)" [];
    case "locate 41.1, -8.7" [ "locate spot, +41.1 -8.7" ];
    case "a = polygon([location(41, 8), location(41.1, 8), location(41.1, 8).displace(0, 900)])"
      [ "a rings, 41 8 / 41.1 8 / fixed" ];
    case
      ("a = polygon([location(41, 8), location(42, 8), location(42, 9)], "
       ^ "holes: [[location(41.5, 8.1), location(41.6, 8.1), location(41.6, 8.2)]])")
      [ "a rings, 41 8 / 42 8 / 42 9, 41.5 8.1 / 41.6 8.1 / 41.6 8.2" ];
    case "q = location(41, 8)\nb = q ^ 200.m\nc = area(location(41, 8), 1.km)\nd = c - b"
      [ "q spot, 41 8"; "b round, fixed, +200"; "c round, 41 8"; "d computed" ];
    case "execute during 2 run followPath([location(41, 8), location(41, 9)])" [ " way, 41 8, 41 9" ];
    case "def f(v) { task('a') }\nmessage(location(41, 8))" [ "location spot, 41 8" ];
    case
      ("p = imcPlan {\n planName 'lane'\n locate 41, 8\n goTo location: location(41.1, 8)\n move 3, 4\n"
       ^ " surveyArea([location(1, 2), location(1, 3), location(2, 3)])\n}")
      [ "lane plan, +41 8, 41.1 8"; "lane way, 1 2, 1 3, 2 3" ] ]

let faulty_shapes () =
  let d = read "a = location(41," in
  Alcotest.(check bool) "faults" true (Result.is_error (Service.shapes d));
  Alcotest.(check int) "its end" 16 (Service.beginning d);
  Alcotest.(check int) "behind comments" 8 (Service.beginning (read "// One\n\na = 1"))

let many_shapes () =
  let list = String.concat ", " (List.init 1_500 (fun i -> Printf.sprintf "location(41.%04d, 8)" i)) in
  let d = read (Printf.sprintf "a = [%s]\nb = [%s]\n" list list) in
  Alcotest.(check int) "one of two" 1 (List.length (Result.get_ok (Service.shapes d)))

let () =
  Alcotest.run "service"
    [ "places", [ case "there and back" positions ]; "names", names; "completion", completion; "calls", calls; "allocations", allocations;
      "arguments of the prelude", preludes; "foreseen", foreseen; "loops without time", timeless;
      "prelude", [ case "completion and hover" prelude ];
      "reference", [ case "is whole" documented; case "is highlighted" highlighted ]; "everywhere", [ anywhere ];
      "shapes", shaped; "limits of shapes", [ case "faults" faulty_shapes; case "many" many_shapes ] ]
