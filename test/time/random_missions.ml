open Dolphin_environment
open Dolphin_time
module Generate = Test_support.Generate
module Calls = Test_support.Calls

let answering = Calls.answering

let environments =
  [ ("as planned", answering);
    ("as planned", answering);
    ("with failures", Environment.failing answering);
    ("with a failure", Environment.failing ~failures:1 answering);
    ("plan p3 may fail", { answering with endings = (fun _ p -> if p = "p3" then May_fail else Succeeds) });
    ("with a loss", { answering with faults = { Faults.none with loss = At_most 1 } }) ]

type durations = Same | By_plan | By_vehicle

let bounds (seed, by) v (p : Dolphin_semantics.Core.platform_task) : Bounds.t =
  let kind = String.make 1 p.name.[0] in
  let n =
    match by with
    | Same -> seed
    | By_plan -> Hashtbl.hash (seed, kind)
    | By_vehicle -> Hashtbl.hash (seed, v, kind)
  in
  let least = n mod 4 in
  if n mod 97 = 0 then Some_time else Within { least = 1000 * least; most = 1000 * (least + (n / 4 mod 4)) }

(* {1 Missions} *)

(* Copies of one task, in which # is the number of the copy, or several tasks, and one that may wait for each. *)
let copy =
  let open QCheck2.Gen in
  let part =
    frequencyl
      [ (3, "task('s#')"); (2, "task('s')"); (2, "idle(2)"); (1, "idle(3)"); (3, "action { post ready: # }");
        (1, "(waitFor { consume go: # } then task('g'))"); (1, "(during 3 run task('d#'))");
        (1, "(task('s#') within 2)"); (1, "action { post go: # }"); (1, "(idle(1) | task('p#'))");
        (1, "(watch task('f#') onError { ignore() })"); (1, "action { post any: 0 }"); (1, "(repeat 2, task('r'))");
        (1, "(repeat 3, (task('r') >> idle(1)))"); (1, "(repeat 2, (task('r#') >> idle(2)))");
        (1, "(task('e#') ensure { post ready: # })"); (1, "((idle(1) | task('e')) ensure { post any: 0 })");
        (1, "((task('s#') within 2) ensure { last = # })"); (1, "(using lock: _ run task('u#'))");
        (1, "(using lock: 1 run idle(1))"); (1, "(task('e') ensure { last = 5; post any: # })");
        (2, "action { message 'copy #' }"); (1, "action { message last + # }"); (2, "task('l#') >> idle(1) >> task('m')");
        (1, "action { message 6 / (last - 5) }"); (1, "(watch (task('f') >> task('s#')) onError { task('h') })");
        (1, "(watch task('f#') onError { e -> last = # })"); (1, "(watch (task('s') >> idle(1)) onError { retry() })") ]
  in
  map (String.concat " >> ") (list_size (int_range 1 4) part)

let numbered n separator text =
  let copy i = Str.global_replace (Str.regexp_string "#") (string_of_int (i + 1)) text in
  String.concat separator (List.init n copy)

let visitor n =
  let open QCheck2.Gen in
  frequency
    [ (1, return ""); (3, return (numbered n "\n" "  when { consume ready: # } then task('v#')"));
      (1, return (numbered n "\n" "  when { consume ready: # } then idle(1)"));
      (1, return (numbered n "\n" "  when { consume go: # } then task('v')")) ]

let mission =
  let open QCheck2.Gen in
  let* n = int_range 2 3 in
  let* copies =
    frequency
      [ (3, map (fun copy -> numbered n " | " ("(" ^ copy ^ ")")) copy);
        (1, map (fun all -> String.concat " | " (List.map (fun copy -> numbered 1 "" ("(" ^ copy ^ ")")) all))
           (list_repeat n copy)) ] in
  let* visitor = visitor n in
  let* beside =
    oneofl [ ""; ""; " | idle(4)"; " | action { post ready: 1 }"; " | (idle(1) >> action { consume any: 0 })" ] in
  let* after =
    oneofl [ ""; "execute idle(1)\n"; "execute UUVs: task('z') | task('z')\n"; "clear = poll(ready: 1)\n";
             "if (last == 2) { execute idle(7) }\n"; "if (poll(any: 2)) { execute idle(7) }\n";
             "if (consume(lock: _) == 2) { execute idle(7) }\n" ] in
  let* around = frequencyl [ (6, ""); (1, " during 3"); (1, " within 4"); (2, " onError { task('home') }") ] in
  let visits = if visitor = "" then "" else Printf.sprintf ", UAV: allOf {\n%s\n}" visitor in
  return
    (Printf.sprintf
       "last = 0\npost lock: 1, lock: 2\nUUVs = pick { count 3; type 'UUV' }\nUAV = pick { type 'UAV' }\n\
        execute UUVs: %s(%s%s)%s%s\n%s"
       (if String.contains around 'E' then "watch " else "") copies beside around visits after)

type program = Mission of string | Any of Dolphin_syntax.Ast.program

type case = program * (int * durations) * (string * Environment.options)

let world =
  let open Test_support.Pure_run in
  world [ vehicle "a"; vehicle "b"; vehicle "c"; vehicle "d" ~kind:"UAV" ]

(* In a third of the cases, some plans charge, of those that take equally long too. *)
let charges (seed, _) name = if seed mod 3 = 0 && Hashtbl.hash (seed, name) mod 2 = 0 then Some 2. else None

let options (program, durations, (_, environment)) : Clocked.options =
  let program, world =
    match program with
    | Mission text -> (Test_support.Pure_run.compile_exn text, world)
    | Any ast -> (Generate.compile ast, Generate.world)
  in
  { environment; program; world;
    durations =
      { task = (fun v _ p -> bounds durations v p); announced = Bounds.exactly 1.; silence = Bounds.exactly 2.;
        posted = (fun _ -> Some_time); place = (fun _ -> None); links = Links.none;
        charges = charges durations; has_chargers = (fun _ -> false) };
    dates = Dolphin_semantics.Dated_code.named program }

let case =
  let open QCheck2.Gen in
  let* depth = int_range 0 2 in
  let nested = map (fun t -> Generate.executing t) (Generate.nested ~vehicles:Generate.vehicles ~depth) in
  let any = map (fun ast -> Any ast) (frequency [ (3, Generate.replicated); (2, nested); (1, Generate.program) ]) in
  let program = frequency [ (2, map (fun text -> Mission text) mission); (1, any) ] in
  let durations = pair (int_bound 1_000_000) (oneofl [ Same; By_plan; By_plan; By_plan; By_vehicle ]) in
  triple program durations (oneofl environments)

let print (program, (seed, by), (name, _)) =
  let by = match by with Same -> "alike" | By_plan -> "by plan" | By_vehicle -> "by vehicle" in
  let text = match program with Mission text -> text | Any ast -> Generate.print ast in
  Printf.sprintf "%s, durations %s %d:\n%s" name by seed text

let batteries =
  let vehicle (v, charge) =
    Printf.sprintf "vehicle '%s', { type 'UUV'; drain 36.percent; battery 99.93.percent; charge %d.percent }\n" v charge in
  let all = [ ("a", 0); ("b", 18); ("c", 0); ("d", 200) ] in
  match Dolphin_scenario.Scenario.read ~file:"batteries" (String.concat "" (List.map vehicle all)) with
  | Ok scenario -> scenario.vehicles
  | Error _ -> failwith "the fleet is wrong"
