open Dolphin_semantics
open Dolphin_tla
module Pure_run = Test_support.Pure_run

let case name f = Alcotest.test_case name `Quick f
let list (xs : Core.value list) : Core.value = List (Vector.of_list xs)

(* {1 Numbers} *)

let fractions () =
  let check n expected =
    Alcotest.(check (option (pair int int))) (Printf.sprintf "%.17g" n) expected (Fraction.of_float n)
  in
  check 0. (Some (0, 1));
  check 0.3 (Some (3, 10));
  check (-8.7062) (Some (-43531, 5000));
  check 12. (Some (12, 1));
  check 2e9 (Some (2_000_000_000, 1));
  check 3e9 None;
  check 1e-300 None;
  check Float.pi None;
  check infinity None;
  check Float.nan None

let texts () =
  let check e text = Alcotest.(check string) text text (Format.asprintf "%a" Tla.pp e) in
  check (Tla.String "a\"b\\c\n") {|"a\"b\\c\n"|};
  check (Tuple []) "<< >>";
  check (Record [ ("is", String "x"); ("n", Integer (-1)) ]) {|[ is |-> "x", n |-> -1 ]|};
  check (Set [ Boolean true ]) "{ TRUE }"

(* {1 Programs} *)

module Environment = Dolphin_environment.Environment

let translate ?(world = Pure_run.fleet) ?(environment = Environment.default) ?calls source =
  Model.of_program ~environment ?calls world (Pure_run.compile_exn source)

(* With vehicles that may be anywhere. *)
let open_world =
  List.fold_left
    (fun world (s : World.vehicle_state) -> World.open_position s.id [] world)
    Pure_run.fleet (World.vehicles Pure_run.fleet)

let refused ?world source line part () =
  match translate ?world source with
  | Ok _ -> Alcotest.failf "translated, but it has %s" part
  | Error ds ->
    let is_it (d : Dolphin_syntax.Diagnostic.t) =
      Dolphin_syntax.Location.line d.at = line
      && Str.string_match (Str.regexp (".*" ^ Str.quote part)) d.message 0
    in
    if not (List.exists is_it ds) then Alcotest.failf "refused otherwise:\n%s" (Pure_run.explain source ds)

let refusals =
  [ case "locations that the program computes" (refused "x = 41\np = location x, -8" 2 "coordinates are not constants");
    case "plans that it computes"
      (refused "n = 5\np = imcPlan { planName 'p'; locate Location.APDL\n loiter radius:n }" 3 "depends on computed values");
    case "code in plans" (refused "p = imcPlan {\nif (1) { speed 2 }\nlocate Location.APDL; goTo() }" 2 "code among its settings");
    case "large numbers" (refused "message 'a'\nmessage 10000000000" 2 "beyond TLC's whole numbers");
    case "trigonometry" (refused "x = 2\ny = Math.sin(x)" 2 "Math.sin");
    case "coordinates of a vehicle that is in a place"
      (refused "v = pick { }\nmessage position(v).latitude > 41" 2 "latitude");
    case "coordinates of what may be no vehicle"
      (refused ~world:open_world "v = [position: Location.APDL]\nmessage v.position.latitude > 41" 2 "latitude");
    case "how long plans take"
      (refused "v = pick { }\np = imcPlan { locate Location.APDL; goTo() }\nmessage p.duration(v)" 3 "the duration of a plan");
    case "how long plans are" (refused "p = imcPlan { locate Location.APDL; goTo() }\nmessage p.length" 2 "length, which may be that of a plan");
    case "a text as a time of day" (refused "t = '21:30'\nmessage timeOfDay(t)" 2 "timeOfDay");
    case "when a vehicle is there" (refused "v = pick { }\nmessage eta(v, Location.APDL)" 2 "eta");
    case "methods of strings" (refused "message 'a'.toUpperCase()" 1 "toUpperCase") ]

let translated ?world source () =
  match translate ?world source with
  | Ok files ->
    Alcotest.(check (list string)) "files"
      ([ "MC.tla"; "MC.cfg"; "Told.cfg"; "Graph.cfg"; "Coverage.cfg"; "MCRefinement.tla"; "Refinement.cfg" ]
       @ List.map fst Spec.modules)
      (List.map (fun (file : Model.file) -> file.name) files)
  | Error ds -> Alcotest.failf "refused:\n%s" (Pure_run.explain source ds)

let constants =
  [ case "constant locations" (translated "p = location(41.185, -8.7062) ^ 2.km");
    case "constant trigonometry" (translated "message Math.floor(Math.sin(1))");
    case "coordinates of a vehicle that may be anywhere"
      (translated ~world:open_world
         "v = pick { }\nmessage position(v).latitude > 41 && position(v).bearing(Location.APDL) > 0");
    case "plans by name" (translated "i = 1\np = imcPlan { planName 'p' + i\n locate Location.APDL; loiter radius:100 }") ]

(* {1 Replies} *)

let source = "s = getSupplier()\ns.next()"

let replying rounds : Environment.options =
  { Environment.default with replies = (function "s.next" -> rounds | _ -> []) }

let definition name rounds =
  match translate ~environment:(replying rounds) ~calls:[ "s.next" ] source with
  | Error ds -> Alcotest.failf "refused:\n%s" (Pure_run.explain source ds)
  | Ok files ->
    let text = (List.find (fun (file : Model.file) -> file.name = "MC.tla") files).text in
    let from = Str.search_forward (Str.regexp ("^MC" ^ name)) text 0 in
    String.sub text from (Str.search_forward (Str.regexp "\n\n") text from - from)

let task name : Core.value = Task (Platform { name; plan = None; task_site = Fault.unknown_site })

let replies () =
  let check name rounds expected = Alcotest.(check string) name expected (definition name rounds) in
  check "HostReplies" [] "MCHostReplies(call, at) ==\n  CASE call = \"s.next\" -> << >>\n    [] OTHER -> << >>";
  check "HostReplies"
    [ [ Ok (list [ task "p"; Host "q" ]); Error "shut" ] ]
    ({|MCHostReplies(call, at) ==
  CASE call = "s.next" -> << << << "value", << "list", << << "task", |}
     ^ {|[ op |-> "platform", name |-> "p", plan |-> 0, at |-> at ] >>, << "host", "q" >> >> >> >>, |}
     ^ {|<< "failure", "shut" >> >> >>
    [] OTHER -> << >>|});
  check "Calls" [ [ Ok Null ] ] "MCCalls == { }";
  check "Calls" [ [ Ok Null ]; [ Ok (Boolean true) ] ] "MCCalls == { \"s.next\" }"

let unfit_replies () =
  let program = Pure_run.compile_exn source in
  let check rounds expected =
    let environment = replying rounds in
    Alcotest.(check (list (pair string string)))
      "unfit" expected
      (Model.unfit_replies ~environment ~calls:[ "getSupplier"; "s.next" ] Pure_run.fleet program)
  in
  check [ [ Ok (Integer 3) ]; [ Ok (Number 0.5) ] ] [];
  check
    [ [ Ok (Map [ ("n", Integer 10_000_000_000) ]) ] ]
    [ ("s.next", "cannot be translated to TLA+: 10000000000 is beyond TLC's whole numbers, which have 32 bits") ]

(* {1 Models written by hand} *)

let read path =
  let channel = open_in_bin path in
  Fun.protect ~finally:(fun () -> close_in channel) (fun () -> really_input_string channel (in_channel_length channel))

(* Some model is about each rule. *)
let rules_have_models () =
  let text = read "../../spec/README.md" in
  let has rule =
    match Str.search_forward (Str.regexp ("[ |]" ^ Str.quote (Rule.name rule) ^ "[ ,]")) text 0 with
    | _ -> true
    | exception Not_found -> false
  in
  let missing = List.filter (fun rule -> not (has rule)) Rule.all in
  Alcotest.(check (list string)) "rules without a model" [] (List.map Rule.name missing)

let models =
  [ "Paper"; "Platform"; "CodeOfTasks"; "Sequence"; "Parallel"; "Branches"; "Until"; "Time"; "Errors"; "Recovery";
    "Rounds"; "Made"; "Recruits"; "Fresh"; "Ensuring"; "Deeds"; "Picking"; "Sensors"; "Dates"; "Waiting"; "Executing";
    "Inputs"; "Ends"; "Leaving"; "SmallAbstract" ]

let configurations =
  List.filter (fun name -> Filename.check_suffix name ".cfg") (Array.to_list (Sys.readdir "../../spec/models"))

(* [f run] where [run arguments] is the status and the output of Java with TLC's classes in a directory with all
   models. *)
let with_tlc f ({ java; jar } : Dolphin_tlc.Installation.t) =
  let directory = Filename.temp_file "dolphin" ".tla" in
  Sys.remove directory;
  Unix.mkdir directory 0o700;
  let path = Filename.concat directory in
  let write name text =
    let channel = open_out_bin (path name) in
    output_string channel text;
    close_out channel
  in
  let copy name = write name (read ("../../spec/models/" ^ name)) in
  copy "Model.tla";
  List.iter (fun name -> copy (name ^ ".tla")) models;
  List.iter copy configurations;
  List.iter (fun (name, text) -> write name text) Spec.modules;
  let run arguments =
    let command =
      Printf.sprintf "cd %s && %s -Xss64m -XX:+UseSerialGC -Djava.io.tmpdir=. -cp %s %s > output 2>&1"
        (Filename.quote directory) (Filename.quote java) (Filename.quote jar) arguments
    in
    let status = Sys.command command in
    (status, read (path "output"))
  in
  let remove () = ignore (Sys.command (Printf.sprintf "rm -r %s" (Filename.quote directory))) in
  Fun.protect ~finally:remove (fun () -> f run)

let has text part =
  match Str.search_forward (Str.regexp_case_fold part) text 0 with _ -> true | exception Not_found -> false

(* Without a warning. *)
let models_parse =
  with_tlc (fun run ->
      let arguments = String.concat " " (List.map (fun name -> name ^ ".tla") models) in
      let status, output = run ("tla2sany.SANY " ^ arguments) in
      if status <> 0 || has output "\\(^\\|[^a-z]\\)\\(warning\\|\\*\\*\\* errors\\|could not\\)" then
        Alcotest.failf "SANY says:\n%s" output)

(* A model without a configuration of its own has that of all. *)
let holds ?states name =
  with_tlc (fun run ->
      let configuration = if List.mem (name ^ ".cfg") configurations then name else "Model" in
      let status, output = run (Printf.sprintf "tlc2.TLC -config %s.cfg %s.tla" configuration name) in
      let as_many n = has output (Printf.sprintf "%d distinct states found" n) in
      if status <> 0 || not (Option.fold states ~none:true ~some:as_many) then Alcotest.failf "TLC says:\n%s" output)

(* TLC takes some seconds to begin: all models are checked if DOLPHIN_LONG is set. *)
let checked =
  let others = List.filter (fun name -> name <> "Waiting") models in
  ("Waiting holds", holds ~states:12 "Waiting")
  :: (if Sys.getenv_opt "DOLPHIN_LONG" = None then [] else List.map (fun name -> (name ^ " holds", holds name)) others)

let tlc =
  Result.map_error (Format.asprintf "%a" Dolphin_tlc.Installation.pp_trouble)
    (Dolphin_tlc.Installation.find Sys.getenv_opt)

let () =
  Alcotest.run "tla"
    [ ("numbers", [ case "are fractions" fractions; case "and texts" texts ]);
      ("refused", refusals);
      ("constants", constants);
      ("replies", [ case "are a constant" replies; case "that do not fit" unfit_replies ]);
      ( "models",
        case "each rule has one" rules_have_models
        :: Test_support.Requiring.cases tlc (("are well formed", models_parse) :: checked) ) ]
