open Dolphin_plans
module Ast = Dolphin_syntax.Ast
module Location = Dolphin_syntax.Location
module Diagnostic = Dolphin_syntax.Diagnostic
module Parameters = Dolphin_syntax.Parameters
open Core

(* Functions may be used before the line that defines them. *)
let declare_function program ((name : string Ast.located), lambda, _, _, _) =
  let wrong ?hint code message = Scope.report program (Diagnostic.error ?hint ~code name.at message) in
  if Scope.find_function program name.it <> None then
    wrong Defined_twice (Printf.sprintf "function '%s' is defined twice" name.it)
  else if Builtins.find name.it <> None || List.mem name.it Builtins.owners then
    wrong Reserved_name
      (Printf.sprintf "'%s' is a name of the language and cannot be defined" name.it)
      ~hint:"choose another name"
  else Scope.add_function program name.it lambda

(* A parameter is set once, by the program or by its user. *)
let declare_parameters program (ast : Ast.program) =
  let declare names (s : Ast.statement) =
    match s.it with
    | Parameter { name; _ } ->
      let wrong code message = Scope.report program (Diagnostic.error ~code name.at message) in
      if List.mem name.it names then wrong Defined_twice (Printf.sprintf "parameter '%s' is declared twice" name.it)
      else if Scope.find_function program name.it <> None then
        wrong Defined_twice (Printf.sprintf "'%s' is a function, and cannot be a parameter too" name.it)
      else if Builtins.is_reserved name.it then
        wrong Reserved_name (Printf.sprintf "'%s' is a name of the language and cannot be a parameter" name.it);
      name.it :: names
    | _ -> names
  in
  ignore (List.fold_left declare [] ast)

let hint_for_unknown name names =
  if name = "include" then Some "include 'lib.dol' stands at the top of a file, outside of all braces"
  else if name = "parameter" then Some "a parameter has a value: parameter n = 3, 'what it is'"
  else if name = "setCommunicationTimeout" then Some "it is called setConnectionTimeout here"
  else if List.mem name [ "sleep"; "wait" ] then Some "the script waits by pause 5.seconds, a task by idle(5.seconds)"
  else if name = Checks.sends_message then Some Checks.hint_for_message
  else if Builtins.math name then Some (Printf.sprintf "write Math.%s" name)
  else if Builtins.constant ("Math." ^ name) <> None then Some (Printf.sprintf "write Math.%s" name)
  else
    match Builtins.example_of_builder name with
    | Some example -> Some ("write " ^ example)
    | None -> Checks.did_you_mean name names

let hint_for_prelude name =
  Option.map
    (fun _ -> Printf.sprintf "%s is a function of the prelude: begin the program with include 'prelude'" name)
    (Dolphin_syntax.Prelude.find name)

let hint_for_setting name =
  Option.map
    (fun builder -> Printf.sprintf "it is a setting of %s: %s { %s ... }" builder builder name)
    (Checks.builder_of_setting name)

let report_unknown ?fallback program =
  let names = Scope.visible_names (Scope.code program Scope.Main None) in
  let near name = hint_for_unknown name (List.filter (fun other -> other <> name) names) in
  let first hints = List.find_map (fun hint -> hint ()) hints in
  let hint name at =
    match Scope.hint_at program at, fallback with
    | Some (true, there), _ -> Some (there name)
    | _, Some fallback -> first [ (fun () -> near name); (fun () -> fallback name) ]
    | there, None ->
      first
        [ (fun () -> hint_for_prelude name); (fun () -> near name);
          (fun () -> Option.map (fun (_, there) -> there name) there); (fun () -> hint_for_setting name) ]
  in
  List.iter
    (fun (name, at) ->
       Scope.report program
         (Diagnostic.error ~code:Unknown_name at
            (Printf.sprintf "unknown name '%s'" name)
            ?hint:(hint name at)))
    (Scope.unknown program)

let report_blocking program =
  List.iter
    (fun (construct, callee, what, at) ->
       let message =
         Printf.sprintf "%s() uses %s, which belongs to the script: the code of %s is part of a task and cannot wait"
           callee what construct
       in
       Scope.report program (Diagnostic.error ~code:Waits_in_task at message))
    (Scope.blocking_calls_in_tasks program)

(* Pairs that the outside posts with such a key are never read. *)
let report_unread_inputs program =
  let report (key : string Ast.located) =
    if not (Scope.is_looked_at program key.it) then
      Scope.report program
        (Diagnostic.warning Unread_input key.at
           (Printf.sprintf "the program neither consumes nor polls '%s'" key.it)
           ~hint:(Printf.sprintf "as in until { poll %s: true } run T" key.it))
  in
  List.iter report (Scope.inputs program)

let is_error (d : Diagnostic.t) = match d.severity with Error -> true | Warning -> false

let is_supplier (e : Ast.expression) =
  match e.it with Call { callee = { it = Variable "getSupplier"; _ }; arguments = [] } -> true | _ -> false

(* Without unused functions of the prelude: they are not part of the program's code. *)
let without_unused_prelude (ast : Ast.program) =
  let is_prelude (s : Ast.statement) = Location.file s.at = Dolphin_syntax.Prelude.file in
  let named names (e : Ast.expression) = match e.it with Variable x -> x :: names | _ -> names in
  let rec reach used names =
    let of_function (s : Ast.statement) =
      match s.it with
      | Function { name; _ } when is_prelude s && List.mem name.it names && not (List.mem name.it used) ->
        Some (name.it, s)
      | _ -> None
    in
    match List.filter_map of_function ast with
    | [] -> used
    | found -> reach (List.map fst found @ used) (List.concat_map (fun (_, s) -> Fold.statement named [] s) found)
  in
  if not (List.exists is_prelude ast) then ast
  else
    let own = List.filter (fun s -> not (is_prelude s)) ast in
    let defined (s : Ast.statement) = match s.it with Function { name; _ } -> Some name.it | _ -> None in
    (* One that the program defines too is kept, so that this is reported. *)
    let used = reach [] (List.filter_map defined own @ List.concat_map (Fold.statement named []) own) in
    let is_kept (s : Ast.statement) =
      match s.it with Function { name; _ } when is_prelude s -> List.mem name.it used | _ -> true in
    List.filter is_kept ast

(* Variables that are assigned once, to a value of a kind that is known. *)
let kinds_of_variables ast =
  let of_kind kind = (kind, Assigned.once (fun e -> Checks.kind_of e = kind) ast) in
  List.map of_kind [ Builtins.Task; Number; String; Vehicles; Position ]

let no_chart _ = Error "no file can be read here"

(* Of the maps in the declarations of fences and places, which are not code. *)
let map_warnings program ~chart ast =
  let of_call (path, at) =
    match chart path with Ok chart -> Chart_calls.warnings at path chart | Error _ -> [] in
  let is_declaration s = Fence_declarations.is_declaration s || Default_place.is_declaration s in
  let statements = List.filter is_declaration ast in
  if Chart_calls.is_call program Chart_calls.word then
    List.iter (Scope.report program) (List.concat_map of_call (Chart_calls.paths statements))

(* Fences are known before anything runs; and so is it of some plans whether they break one. *)
let fences program constants ast =
  if Fence_declarations.is_own ast then Fences.none
  else
    match Fence_declarations.of_program constants ast with
    | Error found -> List.iter (Scope.report program) found; Fences.none
    | Ok [] -> Fences.none
    | Ok declared ->
      let fences = Fences.make declared in
      let plans = Fence_declarations.plans (Lazy.force constants) ast in
      List.iter (Scope.report program) (Fence_declarations.broken fences plans);
      fences

(* Plans of constants that cannot be built; their place may come from the fleet. *)
let report_plans program ~constants ast =
  let plans found (e : Ast.expression) =
    match e.it with Builder ((Imc_plan | Mission), _) -> e :: found | _ -> found in
  match List.fold_left (Fold.statement plans) [] ast with
  | [] -> ()
  | plans -> List.iter (Scope.report program) (List.filter_map (Constants.fault (Lazy.force constants)) plans)

let known_plans ~chart ~place ast = Fence_declarations.plans (Constants.of_program ~chart ~place ast) ast

let plans_without_place ~chart ast =
  Default_place.missing (lazy (Constants.of_program ~chart ~place:None ast)) (without_unused_prelude ast)

let default_place program ~chart ast =
  match Default_place.of_program (lazy (Constants.of_program ~chart ~place:None ast)) ast with
  | Ok place -> place
  | Error found -> List.iter (Scope.report program) found; None

(* Functions, each with its code that is not filled in yet. *)
let functions_of program (ast : Ast.program) =
  let defined (s : Ast.statement) =
    match s.it with
    | Function { name; parameters; body } ->
      Some (name, Lambdas.shell program name.at name.it (List.length parameters), parameters, body, s.at)
    | _ -> None
  in
  List.filter_map defined ast

(* Where only keys of [fresh] are computed for a [consume] of the oldest pair, other keys need no order. *)
let with_computed_orders places (p : Core.program) =
  if places = [] then p
  else begin
    let flow = Code_flow.of_program p in
    let taken = ref [] in
    let note lambda = function
      | Code_walk.Written _, _ -> ()
      | Computed k, _ -> taken := (p.locations.(k.Core.site), Code_flow.key flow lambda k <> None) :: !taken
    in
    let visit lambda (e : Core.expression) =
      match e.node with
      | Apply (Builtin (Consume keys), arguments) -> List.iter (note lambda) (Code_walk.pairs keys arguments)
      | _ -> ()
    in
    Code_walk.iter_within visit (Code_walk.pieces p);
    let is_fresh place =
      match List.filter (fun (at, _) -> at = place) !taken with [] -> false | there -> List.for_all snd there
    in
    let fresh = Tuple_space.with_prefix Residual.key_prefix p.ordered_keys in
    { p with ordered_keys = (if List.for_all is_fresh places then fresh else Tuple_space.every_key) }
  end

let elaborated ?(chart = no_chart) ~source_name (ast : Ast.program) =
  let ast = without_unused_prelude ast in
  let program =
    Scope.create ~variables:(Assigned.names ast) ~suppliers:(Assigned.once is_supplier ast)
      ~kinds:(kinds_of_variables ast)
      ~parameters:(List.map (fun (p : Parameters.t) -> p.name) (Parameters.of_program ast))
      ~given:(Assigned.given ast) ~chart ~functions:[] ~globals:[] ()
  in
  List.iter (Chart_calls.note program) (Chart_calls.assigned ast);
  let defined = functions_of program ast in
  List.iter (declare_function program) defined;
  declare_parameters program ast;
  let at = match ast with first :: _ -> first.at | [] -> Location.none in
  let main = Lambdas.shell program at "the program" 0 in
  let env = Translate.env program (Scope.code program Main None) ~answer:false in
  Lambdas.fill env main Main [] at ast;
  List.iter
    (fun ((name : string Ast.located), lambda, parameters, body, at) ->
       Lambdas.fill env lambda (Scope.Named_function name.it) parameters at body)
    defined;
  report_unknown program;
  report_blocking program;
  report_unread_inputs program;
  List.iter (Scope.report program) (Parallel_check.program ast @ Effect_check.program ast @ Endless_check.program ast);
  map_warnings program ~chart ast;
  let place = default_place program ~chart ast in
  let fences = fences program (lazy (Constants.of_program ~chart ~place ast)) ast in
  if not (List.exists is_error (Scope.reports program)) then begin
    let place = Some (Option.value place ~default:Dolphin_geo.Place.feup) in
    let constants = lazy (Constants.of_program ~chart ~place ast) in
    report_plans program ~constants ast;
    List.iter (Scope.report program) (Rest_check.program constants ast)
  end;
  let reports = Scope.reports program in
  if List.exists is_error reports then Error reports
  else
    Ok
      ( with_computed_orders (Scope.computed_orders program) {
            source_name;
            locations = Scope.locations program;
            global_names = Scope.globals program;
            functions = List.map (fun ((name : string Ast.located), lambda, _, _, _) -> (name.it, lambda)) defined;
            main;
            ordered_keys = Scope.ordered_keys program;
            inputs = List.map (fun (k : string Ast.located) -> k.it) (Scope.inputs program);
            vehicle_inputs = Scope.vehicle_inputs program;
            on_interrupt = Scope.on_interrupt program;
            recruits = Scope.recruits program;
            goes_round = Scope.goes_round program;
            reads_sensors = Scope.reads_sensors program;
            reads_now = Scope.reads_now program;
            reads_time_of_day = Scope.reads_time_of_day program;
            asks_running = Scope.asks_running program;
            fences;
            place;
            begins = None;
          },
        reports )

let program_at ~place ~source_name ast =
  let placed ((p : Core.program), warnings) =
    if p.place <> None then Ok (p, warnings)
    else if place <> None then Ok ({ p with place }, warnings)
    else match plans_without_place ~chart:no_chart ast with [] -> Ok (p, warnings) | found -> Error (warnings @ found)
  in
  Result.bind (elaborated ~source_name ast) placed

let program ~source_name ast = program_at ~place:None ~source_name ast

let program_with_charts ~chart ~source_name ast = elaborated ~chart ~source_name ast

let first_message = function
  | (d : Diagnostic.t) :: _ -> (
      match d.hint with Some hint -> Printf.sprintf "%s (%s)" d.message hint | None -> d.message)
  | [] -> "it is not an expression"

let evaluated ?fallback ?(at_any_date = true) (p : Core.program) ~globals (e : Ast.expression) =
  (* Beyond the program's own sites: sites made here have no place in the program's text. *)
  let first_site = Array.length p.locations in
  let globals = Array.to_list p.global_names @ globals in
  let program = Scope.create ~first_site ~functions:p.functions ~globals () in
  let lambda = Lambdas.shell program e.at "answer" 0 in
  let env = Translate.env program (Scope.code program Main None) ~answer:true in
  Lambdas.fill env lambda Main [] e.at [ { Ast.it = Expression e; at = e.at } ];
  report_unknown ?fallback program;
  match List.filter is_error (Scope.reports program) with
  | [] when Scope.reads_now program && not at_any_date ->
    Error "an answer does not read the date: type the number of seconds"
  | [] -> Ok { lambda; captured = [||] }
  | errors -> Error (first_message errors)

let expression p ~globals e = evaluated p ~globals e

(* As people type them: these words are never variables. *)
let spoken (e : Ast.expression) : Ast.expression =
  match e.it with
  | Variable name -> (
      match String.lowercase_ascii name with
      | "yes" | "y" | "true" -> { e with it = Boolean true }
      | "no" | "n" | "false" -> { e with it = Boolean false }
      | _ -> e)
  | _ -> e

let answer p text =
  match Dolphin_syntax.Parse.expression ~file:"answer" text with
  | Error ds -> Error (first_message ds)
  | Ok e ->
    let fallback name = Some (Printf.sprintf "a text stands in quotes: '%s'" name) in
    (* The analyses of the text must know all uses of the date. *)
    evaluated ~fallback ~at_any_date:false p ~globals:[] (spoken e)
