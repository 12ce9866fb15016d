open Dolphin_semantics
module Environment = Dolphin_environment.Environment
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

(* The values that a sensor may show; none if it may show anything. *)
let values (shown : _ World.shown) value =
  match shown with
  | Anything -> Tla.Tuple []
  | Shows x -> Tla.Tuple [ value x ]
  | One_of xs -> Tla.Tuple (List.map value xs)

let sensed (x : Core.value) =
  match x with
  | Boolean b -> Tla.Tuple [ String "boolean"; Boolean b ]
  | x -> charge (Option.value (Value.to_number x) ~default:0.)

(* Those that code reads; it is refused if one is unknown. TLC is faster if it need not look for readings among
   values. *)
let sensors translation world (s : World.vehicle_state) =
  let one sensor =
    let entry shown =
      Tla.Record
        [ ("name", String (Translation.name_of_sensor sensor)); ("text", String (World.spell sensor s.id));
          ("shows", values shown sensed) ]
    in
    Option.map entry (World.sensor world sensor s)
  in
  Tla.Tuple (List.filter_map one (Translation.sensors translation))

let vehicle translation world (s : World.vehicle_state) =
  let place p = Tla.Integer (Translation.place translation p) in
  let position p = Tla.Tuple [ String "position"; place p ] in
  let whereabouts =
    match World.position world s with
    | Anything when not (Translation.reads_position translation) -> Tla.Tuple [ position s.position ]
    | shown -> values shown position
  in
  Tla.Record
    [ ("id", String s.id); ("type", String s.kind); ("payload", Tla.strings s.payload); ("devices", devices s.payload);
      ("places", Tuple (List.map place (World.places_of world s)));
      ("position", whereabouts);
      ("sensors", sensors translation world s) ]

let ending : Environment.ending -> string = function
  | Succeeds -> "succeeds"
  | May_fail -> "may fail"
  | Fails -> "fails"

(* A name that no program has. *)
let nobody = "\000"

(* The body of Ending(v, p); the most frequent case comes last. *)
let endings (environment : Environment.options) world plans =
  let ids = List.map (fun (s : World.vehicle_state) -> s.id) (World.vehicles world) in
  let usual = match ids with id :: _ -> Environment.ending environment id nobody | [] -> Environment.Succeeds in
  let clause id plan =
    let this = Environment.ending environment id plan in
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
let limit : Dolphin_environment.Faults.limit -> Tla.t = function
  | Never -> Integer 0
  | At_most n -> Integer n
  | Any_number -> Integer (-1)

let late (environment : Environment.options) world =
  let ids = List.map (fun (s : World.vehicle_state) -> s.id) (World.vehicles world) in
  Tla.Set (List.map (fun id -> Tla.String id) (List.filter environment.may_be_late ids))

(* {1 Answers and replies} *)

(* The body of a definition with the parameter [parameter]: [of_name] of each of [names], and of an unused name for
   all others. *)
let cases parameter names of_name =
  let clause name = Format.asprintf "%s = %a -> %a" parameter Tla.pp (Tla.String name) Tla.pp (of_name name) in
  let others = Format.asprintf "%a" Tla.pp (of_name nobody) in
  match names with
  | [] -> others
  | names -> Printf.sprintf "CASE %s\n    [] OTHER -> %s" (String.concat "\n    [] " (List.map clause names)) others

let in_rounds of_one rounds = Tla.Tuple (List.map (fun round -> Tla.Tuple (List.map of_one round)) rounds)

let answer translation program text =
  let lambda, why =
    match Elaborate.answer program text with
    | Ok closure -> (Translation.lambda translation closure.Core.lambda, "")
    | Error why -> (0, why)
  in
  Tla.Record [ ("text", String text); ("lambda", Integer lambda); ("why", String why) ]

let answers translation program (environment : Environment.options) prompts =
  cases "prompt" prompts (fun prompt -> in_rounds (answer translation program) (environment.answers prompt))

let confirmations (environment : Environment.options) prompts =
  let reply = function
    | Ok yes -> Tla.strings [ (if yes then "yes" else "no") ]
    | Error why -> Tla.strings [ "nobody"; why ]
  in
  cases "prompt" prompts (fun prompt -> Tla.Tuple (List.map reply (Environment.confirmations environment prompt)))

(* [at] is a parameter of the definition: the place of the call. *)
let reply translation = function
  | Ok x -> Tla.Tuple [ String "value"; Translation.reply translation ~at:(Name "at") x ]
  | Error why -> Tla.strings [ "failure"; why ]

let replies translation (environment : Environment.options) calls =
  cases "call" calls (fun call -> in_rounds (reply translation) (environment.replies call))

(* The names with several rounds: for these it matters how often they came. *)
let counted names rounds =
  let several name = List.compare_length_with (rounds name) 1 > 0 in
  Tla.Set (List.map (fun name -> Tla.String name) (List.filter several names))

(* {1 Inputs} *)

let inputs translation (program : Core.program) (environment : Environment.options) =
  let of_input (i : Environment.input) =
    let value x = Translation.reply translation ~at:(Tla.Integer 0) x in
    Tla.Record
      [ ("key", String i.key); ("rounds", in_rounds value i.rounds); ("times", Integer i.times);
        ("certain", Boolean i.certain) ]
  in
  let is_declared (i : Environment.input) = List.mem i.key program.inputs in
  Tla.Tuple (List.map of_input (List.filter is_declared environment.inputs))

(* {1 The module} *)

(* TLC recomputes, at each use, the replacement of a constant in a configuration; other definitions it computes once.
   So for large values a name is put there. *)
let tables = [ "Fleet"; "Code"; "Lambdas"; "LambdaNames"; "Places"; "Distances"; "Plans" ]

let small =
  [ "Main"; "OnInterrupt"; "GlobalNames"; "OrderedKeys"; "OrderedPrefixes"; "Prompts"; "Failures"; "Losses";
    "Latecomers"; "MayBeLate"; "Calls"; "Inputs"; "InputKeys"; "SiteOf"; "Ending"; "Answers"; "Confirmations";
    "HostReplies" ]

let definition ppf name e = Format.fprintf ppf "%s == %a@.@." name Tla.pp e

let site (_, at) =
  let text at = Tla.comment (Format.asprintf "%a" Location.pp at) in
  Tla.String (Option.fold at ~none:"" ~some:text)
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

let text program world (environment : Environment.options) plans prompts calls translation main on_interrupt =
  let fleet = List.map (fun s -> (vehicle translation world s, None)) (World.vehicles world) in
  let answers = answers translation program environment prompts in
  let confirmations = confirmations environment prompts in
  let replies = replies translation environment calls in
  let inputs = inputs translation program environment in
  let b = Buffer.create 10_000 in
  let ppf = Format.formatter_of_buffer b in
  Format.pp_set_margin ppf 1_000_000;
  Format.fprintf ppf
    "---- MODULE MC ----@.\\* %s in its world. Made by dolphin tla: generate it again rather than edit it.@."
    (Tla.comment program.Core.source_name);
  Format.fprintf ppf "EXTENDS DolphinChecking@.@.";
  table ppf "MCFleet" fleet;
  table ppf "MCCode" (Translation.code translation);
  table ppf "MCLambdas" (Translation.lambdas translation);
  definition ppf "MCLambdaNames" (Translation.lambda_names translation);
  definition ppf "MCMain" (Tla.Tuple [ String "closure"; Integer main; Tuple [] ]);
  let closure number = Tla.Tuple [ String "closure"; Integer number; Tuple [] ] in
  definition ppf "MCOnInterrupt" (Tla.Tuple (List.map closure on_interrupt));
  definition ppf "MCGlobalNames" (Tla.strings (Array.to_list program.global_names));
  let texts of_order = Tla.Set (List.map (fun k -> Tla.String k) of_order) in
  definition ppf "MCOrderedKeys" (texts program.ordered_keys.named);
  definition ppf "MCOrderedPrefixes" (texts program.ordered_keys.prefixes);
  definition ppf "MCPlaces" (Translation.places translation);
  definition ppf "MCDistances" (Translation.distances translation);
  definition ppf "MCPlans" (Translation.plans translation);
  definition ppf "MCPrompts" (counted prompts environment.answers);
  definition ppf "MCCalls" (counted calls environment.replies);
  definition ppf "MCInputs" inputs;
  let keys = List.sort_uniq String.compare program.inputs in
  definition ppf "MCInputKeys" (Tla.Set (List.map (fun k -> Tla.String k) keys));
  definition ppf "MCFailures" (match environment.faults.fail with Never -> Tla.Integer (-1) | most -> limit most);
  definition ppf "MCLosses" (limit environment.faults.loss);
  definition ppf "MCLatecomers" (limit environment.faults.join);
  definition ppf "MCMayBeLate" (late environment world);
  Format.fprintf ppf "MCSiteOf(n) ==@.  IF n > 0 THEN %a[n] ELSE %a[-n]@.@." Tla.pp
    (sites (Translation.code translation)) Tla.pp (sites (Translation.lambdas translation));
  Format.fprintf ppf "MCEnding(v, p) ==@.  %s@.@." (endings environment world plans);
  Format.fprintf ppf "MCAnswers(prompt) ==@.  %s@.@." answers;
  Format.fprintf ppf "MCConfirmations(prompt) ==@.  %s@.@." confirmations;
  Format.fprintf ppf "MCHostReplies(call, at) ==@.  %s@.@." replies;
  List.iter (fun name -> Format.fprintf ppf "The%s == MC%s@." name name) tables;
  Format.fprintf ppf "====@.";
  Buffer.contents b

(* The module of the program with its times. *)
let timed_text (times : Times.t) ~faults ~plans world (program : Core.program) =
  let definition (head, body) = Printf.sprintf "MC%s ==\n  %s\n\n" head body in
  let definitions = Times.definitions times ~faults ~plans program world in
  "---- MODULE MCTimed ----\nEXTENDS MC, Timed\n\n" ^ String.concat "" (List.map definition definitions) ^ "====\n"

let constants (environment : Environment.options) =
  let replaced by name = Printf.sprintf "  %s <- %s%s\n" name by name in
  "CONSTANTS\n  Known <- ComputedOnce\n"
  ^ String.concat "" (List.map (replaced "The") tables @ List.map (replaced "MC") small)
  ^ Format.asprintf "  Interruptions = %a\n" Tla.pp (Boolean environment.faults.interrupt)
  ^ "  ScriptFuel = 10000\n  AtomicFuel = 2000000\n  MaximumCalls = 10000\n"

let invariants = [ "TypeOK"; "AllocationWithinBound"; "OneTaskEach"; "RecruitedOnce"; "EmptyAfterEnd";
                   "TuplesConserved"; "NoDeadlock" ]

let check environment =
  "SPECIFICATION Spec\nVIEW View\n" ^ constants environment ^ "INVARIANTS " ^ String.concat " " invariants
  ^ "\nPROPERTY Termination\nCHECK_DEADLOCK FALSE\n"

(* Not every TLC knows the word: the one that [make tlc] fetches does not. *)
let told environment = "ALIAS Told\n" ^ check environment

let coverage environment = "INIT CheckedInit\nNEXT NextByRule\n" ^ constants environment ^ "CHECK_DEADLOCK FALSE\n"

let graph environment =
  "INIT CheckedInit\nNEXT GraphNext\n" ^ constants environment ^ "INVARIANT PrintGraph\nCHECK_DEADLOCK FALSE\n"

(* The module that has both the program and the refinement. *)
let refined_module = "---- MODULE MCRefinement ----\nEXTENDS MC, DolphinRefinement\n====\n"

let refinement environment =
  "INIT RefinedInit\nNEXT RefinedNext\n" ^ constants environment
  ^ "INVARIANTS NoneRefused Mapped AbstractInv\nCHECK_DEADLOCK FALSE\n"

let timed times environment =
  let value (name, n) = Printf.sprintf "  %s = %d\n" name n in
  "INIT TimedInit\nNEXT TimedNext\nVIEW TimedView\n" ^ constants environment
  ^ "  Lasts <- MCLasts\n  Posts <- MCPosts\n  CodeDates <- MCCodeDates\n  Links <- MCLinks\n\
    \  SilentAtFirst <- MCSilentAtFirst\n"
  ^ String.concat "" (List.map value (Times.values times))
  ^ "INVARIANT Dates\nCHECK_DEADLOCK FALSE\n"

let timed_files times ~plans ~environment world program =
  [ { name = "MCTimed.tla"; text = timed_text times ~faults:environment.Environment.faults ~plans world program };
    { name = "Timed.cfg"; text = timed times environment } ]

let unfit_replies ~environment ~calls world program =
  let why call =
    let translation = Translation.create program world in
    ignore (replies translation environment [ call ] : string);
    List.map (fun (d : Dolphin_syntax.Diagnostic.t) -> (call, d.message)) (Translation.refusals translation)
  in
  List.concat_map why calls

let of_program ?(plans = []) ?(prompts = []) ?(calls = []) ?times ~environment world program =
  let translation = Translation.create program world in
  let main = Translation.lambda translation program.Core.main in
  let on_interrupt = List.map (Translation.lambda translation) (Option.to_list program.on_interrupt) in
  let text = text program world environment plans prompts calls translation main on_interrupt in
  match Translation.refusals translation with
  | [] ->
    Ok
      ([ { name = "MC.tla"; text }; { name = "MC.cfg"; text = check environment };
         { name = "Told.cfg"; text = told environment }; { name = "Graph.cfg"; text = graph environment };
         { name = "Coverage.cfg"; text = coverage environment };
         { name = "MCRefinement.tla"; text = refined_module };
         { name = "Refinement.cfg"; text = refinement environment } ]
       @ Option.fold times ~none:[] ~some:(fun times -> timed_files times ~plans ~environment world program)
       @ List.map (fun (name, text) -> { name; text }) Spec.modules)
  | refusals -> Error refusals
