open Dolphin_semantics
module Environment = Dolphin_explore.Environment
module Location = Dolphin_syntax.Location

type file = { name : string; text : string }

(* {1 The world} *)

let devices payload = Tla.Set (List.map (fun d -> Tla.String (String.lowercase_ascii d)) payload)

let charge level =
  let n, d =
    match Fraction.of_float level with
    | Some fraction -> fraction
    | None -> (int_of_float (Float.round (level *. 1e6)), 1_000_000)
  in
  Tla.Tuple [ String "number"; Integer n; Integer d ]

let shows world look = List.map snd (World.cases world look)

(* What a sensor may show, nothing if that may be anything. Where no code looks at sensors, they may as well show what
   they show at the start: TLC is faster if it need not look for readings among values. *)
let sensor translation world look value at_start =
  match shows world look with
  | [ None ] when Translation.reads_sensors translation -> Tla.Tuple []
  | [ None ] -> Tla.Tuple [ value at_start ]
  | shown -> Tla.Tuple (List.map value (List.filter_map Fun.id shown))

let vehicle translation world (s : World.vehicle_state) =
  let place p = Tla.Integer (Translation.place translation p) in
  let position p = Tla.Tuple [ String "position"; place p ] in
  Tla.Record
    [ ("id", String s.id); ("type", String s.kind); ("payload", Tla.strings s.payload); ("devices", devices s.payload);
      ("places", Tuple (List.map place (shows world (fun world -> World.place world s))));
      ("position", sensor translation world (fun world -> World.position world s) position s.position);
      ("battery", sensor translation world (fun world -> World.battery world s) charge s.battery) ]

let ending : Environment.endings -> string = function
  | Succeeds -> "succeeds"
  | May_fail -> "may fail"
  | Fails -> "fails"

(* A name that no program has. *)
let nobody = "\000"

(* [v] and [p] as in the definition of Ending; what most have comes last. *)
let endings (environment : Environment.options) world plans =
  let ids = List.map (fun (s : World.vehicle_state) -> s.id) (World.vehicles world) in
  let usual = match ids with id :: _ -> environment.endings id nobody | [] -> Environment.Succeeds in
  let clause id plan =
    let this = environment.endings id plan in
    if this = usual then None
    else
      Some
        (Format.asprintf "v = %a /\\ p = %a -> %a" Tla.pp (Tla.String id) Tla.pp (Tla.String plan) Tla.pp
           (Tla.String (ending this)))
  in
  let clauses = List.concat_map (fun id -> List.filter_map (clause id) plans) ids in
  let usual = Format.asprintf "%a" Tla.pp (Tla.String (ending usual)) in
  match clauses with
  | [] -> usual
  | clauses -> Printf.sprintf "CASE %s\n    [] OTHER -> %s" (String.concat "\n    [] " clauses) usual

(* -1 stands for any number. *)
let limit : Environment.limit -> Tla.t = function
  | Never -> Integer 0
  | At_most n -> Integer n
  | Any_number -> Integer (-1)

let late (environment : Environment.options) world =
  let ids = List.map (fun (s : World.vehicle_state) -> s.id) (World.vehicles world) in
  Tla.Set (List.map (fun id -> Tla.String id) (List.filter environment.may_be_late ids))

(* {1 Answers} *)

let answer translation program text =
  let lambda, why =
    match Elaborate.answer program text with
    | Ok closure -> (Translation.lambda translation closure.Core.lambda, "")
    | Error why -> (0, why)
  in
  Tla.Record [ ("text", String text); ("lambda", Integer lambda); ("why", String why) ]

let rounds translation program texts =
  Tla.Tuple (List.map (fun round -> Tla.Tuple (List.map (answer translation program) round)) texts)

let answers translation program (environment : Environment.options) prompts =
  let clause prompt =
    Format.asprintf "prompt = %a -> %a" Tla.pp (Tla.String prompt) Tla.pp
      (rounds translation program (environment.answers prompt))
  in
  let others = Format.asprintf "%a" Tla.pp (rounds translation program (environment.answers nobody)) in
  match prompts with
  | [] -> others
  | prompts -> Printf.sprintf "CASE %s\n    [] OTHER -> %s" (String.concat "\n    [] " (List.map clause prompts)) others

(* {1 The module} *)

(* What is put in the place of a constant TLC computes anew whenever it is used, other definitions once: so for what is
   large, a name of it is put there. *)
let tables = [ "Fleet"; "Code"; "Lambdas"; "LambdaNames"; "Places"; "Distances"; "Plans" ]

let small =
  [ "Main"; "GlobalNames"; "OrderedKeys"; "Prompts"; "Failures"; "Losses"; "Latecomers"; "MayBeLate"; "HostReplies";
    "SiteOf"; "Ending"; "Answers" ]

let definition ppf name e = Format.fprintf ppf "%s == %a@.@." name Tla.pp e

let site (_, at) = Tla.String (match at with Some at -> Format.asprintf "%a" Location.pp at | None -> "")
let sites rows = Tla.Tuple (List.map site rows)

(* A row for each number, with the place in the program that it stands for. *)
let table ppf name rows =
  let last = List.length rows - 1 in
  Format.fprintf ppf "%s == <<@." name;
  List.iteri
    (fun i (row, at) ->
       Format.fprintf ppf "  %a%s" Tla.pp row (if i = last then "" else ",");
       let place = match at with Some at -> Format.asprintf " at %a" Location.pp at | None -> "" in
       Format.fprintf ppf "  \\* %d%s@." (i + 1) (Tla.comment place))
    rows;
  Format.fprintf ppf ">>@.@."

let text program world (environment : Environment.options) plans prompts translation main =
  let answers = answers translation program environment prompts in
  let fleet = List.map (fun s -> (vehicle translation world s, None)) (World.vehicles world) in
  let several prompt = List.length (environment.answers prompt) > 1 in
  let b = Buffer.create 10_000 in
  let ppf = Format.formatter_of_buffer b in
  Format.pp_set_margin ppf 1_000_000;
  Format.fprintf ppf
    "---- MODULE MC ----@.\\* %s in its world. Made by dolphin tla: make it anew rather than change it.@."
    (Tla.comment program.Core.source_name);
  Format.fprintf ppf "EXTENDS Dolphin@.@.";
  table ppf "MCFleet" fleet;
  table ppf "MCCode" (Translation.code translation);
  table ppf "MCLambdas" (Translation.lambdas translation);
  definition ppf "MCLambdaNames" (Translation.lambda_names translation);
  definition ppf "MCMain" (Tla.Tuple [ String "closure"; Integer main; Tuple [] ]);
  definition ppf "MCGlobalNames" (Tla.strings (Array.to_list program.global_names));
  definition ppf "MCOrderedKeys" (Tla.Set (List.map (fun k -> Tla.String k) program.ordered_keys));
  definition ppf "MCPlaces" (Translation.places translation);
  definition ppf "MCDistances" (Translation.distances translation);
  definition ppf "MCPlans" (Translation.plans translation);
  definition ppf "MCPrompts" (Tla.Set (List.map (fun p -> Tla.String p) (List.filter several prompts)));
  definition ppf "MCFailures" (Tla.Integer (Option.value environment.failures ~default:(-1)));
  definition ppf "MCLosses" (limit environment.losses);
  definition ppf "MCLatecomers" (limit environment.latecomers);
  definition ppf "MCMayBeLate" (late environment world);
  definition ppf "MCHostReplies" (Tla.Tuple []);
  Format.fprintf ppf "MCSiteOf(n) ==@.  IF n > 0 THEN %a[n] ELSE %a[-n]@.@." Tla.pp (sites (Translation.code translation))
    Tla.pp (sites (Translation.lambdas translation));
  Format.fprintf ppf "MCEnding(v, p) ==@.  %s@.@." (endings environment world plans);
  Format.fprintf ppf "MCAnswers(prompt) ==@.  %s@.@." answers;
  List.iter (fun name -> Format.fprintf ppf "The%s == MC%s@." name name) tables;
  Format.fprintf ppf "====@.";
  Buffer.contents b

let constants =
  let replaced by name = Printf.sprintf "  %s <- %s%s\n" name by name in
  "CONSTANTS\n  Known <- ComputedOnce\n"
  ^ String.concat "" (List.map (replaced "The") tables @ List.map (replaced "MC") small)
  ^ "  Interruptions = FALSE\n  ScriptFuel = 10000\n  AtomicFuel = 2000000\n  MaximumCalls = 10000\n"

let invariants = [ "TypeOK"; "AllocationWithinBound"; "OneTaskEach"; "EmptyAfterEnd"; "TuplesConserved"; "NoDeadlock" ]

let check =
  "SPECIFICATION Spec\n" ^ constants ^ "INVARIANTS " ^ String.concat " " invariants
  ^ "\nPROPERTY Termination\nCHECK_DEADLOCK FALSE\n"

(* Not every TLC knows the word: the one that [make tlc] fetches does not. *)
let told = "ALIAS Told\n" ^ check

let coverage = "INIT Init\nNEXT NextByRule\n" ^ constants ^ "CHECK_DEADLOCK FALSE\n"

let graph = "INIT Init\nNEXT Next\n" ^ constants ^ "INVARIANT PrintGraph\nCHECK_DEADLOCK FALSE\n"

let of_program ?(plans = []) ?(prompts = []) ~environment world program =
  let translation = Translation.create program world in
  let main = Translation.lambda translation program.Core.main in
  let text = text program world environment plans prompts translation main in
  match Translation.refusals translation with
  | [] ->
    Ok
      [ { name = "MC.tla"; text }; { name = "MC.cfg"; text = check }; { name = "Told.cfg"; text = told };
        { name = "Graph.cfg"; text = graph }; { name = "Coverage.cfg"; text = coverage };
        { name = "Dolphin.tla"; text = Spec.dolphin }; { name = "DolphinMachine.tla"; text = Spec.machine };
        { name = "DolphinValues.tla"; text = Spec.values } ]
  | refusals -> Error refusals
