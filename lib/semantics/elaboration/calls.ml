open Core
open Checks
open Closures
module Prelude = Dolphin_syntax.Prelude

let values env = List.map (fun a -> elaborate env (value_of a))
let is_named = function Ast.Named _ -> true | Positional _ | Keyed _ -> false
let name_of = function Ast.Named (k, _) -> Some k.Ast.it | Positional _ | Keyed _ -> None

(* Only pairs of N have keys that are computed. *)
let without_keys env arguments =
  let argument = function
    | Ast.Keyed (k, e) ->
      error env No_pairs k.at "only post, consume, poll and count take keys that are computed";
      Ast.Positional e
    | (Positional _ | Named _) as a -> a
  in
  List.map argument arguments

(* [if (!C()) ...]: the text is computed only if the condition does not hold. *)
let assertion env at arguments =
  let not_code at =
    error env Wrong_kind at "assert takes code { ... } with a condition" ~hint:"write assert { CONDITION }, 'TEXT'"
  in
  let failing text = apply env at (Builtin Assert) text in
  let holds (c : Ast.closure) closure_at =
    let closure = task_code env closure_at "assert" c in
    apply env closure_at (Call []) [ closure ]
  in
  match arguments with
  | [ Ast.Positional { it = Closure c; at = closure_at } ] ->
    expression env at (If (holds c closure_at, null env at, failing []))
  | [ Ast.Positional { it = Closure c; at = closure_at }; Ast.Positional text ] ->
    let test = holds c closure_at in
    expression env at (If (test, null env at, failing [ elaborate env text ]))
  | first :: _ :: _ :: _ ->
    let first = value_of first in
    error env Wrong_arity first.at "assert takes code and a text, not %d arguments" (List.length arguments);
    null env at
  | [ _; Ast.Named (k, _) ] -> error env Unknown_argument k.at "assert takes no argument by name"; null env at
  | first :: _ -> not_code (value_of first).at; null env at
  | [] -> not_code at; null env at

(* As an operand, an assertion is a task: [action { assert { C }, TEXT }]. *)
let assertion_task env at arguments =
  let body env at = assertion env at arguments in
  let lambda, captured = make_lambda env at (Scope.Task_code "assert") "assert" ~parameters:[] ~implicit:false body in
  apply env at (Builtin Make_action) [ expression env at (Make_closure (lambda, captured)) ]

(* [x = ask Q; while (x is neither true nor false) x = ask "Q (yes or no)"]: no rule of its own. *)
let confirm env at arguments =
  match prompt_of env at arguments with
  | None -> null env at
  | Some prompt ->
    let question = Scope.new_slot env.code and answer = Scope.new_slot env.code in
    let ask prompt = set_local env at answer (apply env at (Builtin Ask) [ prompt ]) in
    let truth b = constant env at (Boolean b) in
    let is b = apply env at (Binary Equal) [ local env at answer; truth b ] in
    let first = set_local env at question (apply env at Concatenate [ elaborate env prompt ]) in
    let asked = ask (local env at question) in
    let open_ = expression env at (If (is true, truth false, apply env at (Unary Not) [ is false ])) in
    let again = ask (apply env at Concatenate [ local env at question; constant env at (String " (yes or no)") ]) in
    block env at [ first; asked; expression env at (While (open_, again)); local env at answer ]

(* [fresh { k, k' -> T }]: code of keys, run when the task is given its vehicles. *)
let fresh env at arguments =
  let example = "write fresh { k -> T }; code in T may use the key k: post((k): 1)" in
  match arguments with
  | [ Ast.Positional { it = Closure ({ parameters = Some (_ :: _); _ } as c); at = code_at } ] ->
    apply env at (Builtin Make_fresh) [ told c (closure env code_at Scope.Maker "fresh" c) ]
  | [ Ast.Positional { it = Closure _; at } ] ->
    error env Wrong_parameters at "the code of fresh takes its keys as parameters" ~hint:example;
    null env at
  | [ Ast.Positional e ] ->
    check_kind env "fresh" Closure e;
    apply env at (Builtin Make_fresh) [ elaborate env e ]
  | [ Ast.Named (k, _) ] -> error env Unknown_argument k.at "fresh takes no argument by name"; null env at
  | arguments ->
    error env Wrong_arity at "fresh takes 1 argument, not %d" (List.length arguments) ~hint:example;
    null env at

let input env at arguments =
  let wrong at = error env Wrong_kind at "input takes keys in quotes" ~hint:"write input 'abort'" in
  let is_of_vehicle = function
    | Ast.Named ({ it = "of"; _ }, { it = Ast.String "vehicle"; _ }) -> true
    | Named _ | Positional _ | Keyed _ -> false
  in
  let of_vehicle = List.exists is_of_vehicle arguments in
  let key = function
    | Ast.Positional { it = String key; at } when key <> "" ->
      Pairs.check_own env key at;
      if Scope.is_input env.program key then
        error env Defined_twice at "input '%s' is declared twice" key
      else Scope.note_input env.program ~of_vehicle { Ast.it = key; at }
    | Ast.Positional { at; _ } | Keyed ({ at; _ }, _) -> wrong at
    | Ast.Named ({ it = "of"; _ }, { at; _ }) ->
      error env Wrong_kind at "values of an input are any, or vehicles" ~hint:"write input 'hold', of: 'vehicle'"
    | Ast.Named (k, _) -> wrong k.Ast.at
  in
  if List.for_all is_of_vehicle arguments then wrong at;
  List.iter key (List.filter (fun a -> not (is_of_vehicle a)) arguments);
  null env at

(* [{ vs -> T }] is called with the bound vehicles: the task that it gives is executed then. *)
let on_interrupt env at arguments =
  let made vehicles (c : Ast.closure) at inside =
    let code = told c (closure inside at Scope.Maker "onInterrupt" c) in
    let given = if c.parameters = Some [] then [] else [ local inside at vehicles ] in
    apply inside at (Call (List.map (fun _ -> None) given)) (code :: given)
  in
  let task vehicles (e : Ast.expression) inside =
    match e.it with
    | Closure ({ parameters = Some (_ :: second :: _); _ } as c) ->
      error env Wrong_parameters second.at "the code of onInterrupt takes one parameter, the vehicles picked";
      made vehicles c e.at inside
    | Closure c -> made vehicles c e.at inside
    | _ -> task_operand inside e
  in
  let declare (e : Ast.expression) =
    check_kind env "onInterrupt" Task e;
    let body inside at =
      let vehicles = Scope.new_slot inside.code in
      apply inside at (Builtin Interrupted) [ apply inside at (Builtin Execute) [ task vehicles e inside ] ]
    in
    let lambda, _ = make_lambda env at Scope.Maker "onInterrupt" ~parameters:[] ~implicit:false body in
    if Scope.on_interrupt env.program <> None then
      error env Defined_twice at "onInterrupt is declared twice" ~hint:"tasks at once are a | b";
    Scope.note_interrupt env.program { lambda with parameters = 1 }
  in
  (match arguments with
   | [ Ast.Positional e ] -> declare e
   | [ Ast.Named (k, _) ] ->
     error env Unknown_argument k.at "onInterrupt takes no argument by name" ~hint:"write onInterrupt T"
   | arguments ->
     error env Wrong_arity at "onInterrupt takes one task, not %d" (List.length arguments)
       ~hint:"write onInterrupt task('home'), or onInterrupt { vs -> T } with the vehicles picked");
  null env at

let number_of_arguments least most =
  match least, most with
  | 0, 0 -> "no arguments"
  | 1, 1 -> "1 argument"
  | least, most when least = most -> Printf.sprintf "%d arguments" least
  | least, most -> Printf.sprintf "%d to %d arguments" least most

let execute env at arguments =
  match arguments with
  | [ Ast.Positional e ] ->
    check_kind env "execute" Task e;
    apply env at (Builtin Execute) [ task_operand env e ]
  | _ :: _ when List.for_all is_named arguments ->
    let part = function
      | Ast.Named ({ it = "_"; _ }, e) -> [ task_operand env e ]
      | Ast.Named (k, e) ->
        check_kind env "execute" Task e;
        let vehicles = Names.elaborate env k.it k.at in
        [ vehicles; task_operand env e ]
      | Ast.Positional e | Keyed (_, e) -> [ task_operand env e ]
    in
    let names = List.filter_map name_of arguments in
    apply env at (Builtin (Execute_for names)) (List.concat_map part arguments)
  | _ ->
    error env Wrong_arity at "execute takes one task, or tasks by the vehicles that run them"
      ~hint:"write execute T, or execute v1: T1, v2: T2";
    null env at

let set_connection_timeout env at arguments =
  match arguments with
  | [ Ast.Positional e ] ->
    check_kind env "setConnectionTimeout" Number e;
    apply env at (Builtin Set_connection_timeout) [ elaborate env e ]
  | [ Ast.Positional v; Ast.Positional e ] ->
    check_kind env "setConnectionTimeout" Vehicles v;
    check_kind env "setConnectionTimeout" Number e;
    let v = elaborate env v in
    apply env at (Builtin Set_connection_timeout) [ v; elaborate env e ]
  | _ :: _ when List.for_all is_named arguments ->
    let one = function
      | Ast.Named (k, e) ->
        check_kind env "setConnectionTimeout" Number e;
        let v = Names.elaborate env k.it k.at in
        apply env at (Builtin Set_connection_timeout) [ v; elaborate env e ]
      | Ast.Positional e | Keyed (_, e) -> elaborate env e
    in
    block env at (List.map one arguments)
  | _ ->
    error env Wrong_arity at "setConnectionTimeout takes a time, or vehicles and a time"
      ~hint:"write setConnectionTimeout v1, 2.min";
    null env at

let check_literals env at operation kinds arguments =
  let es = List.map value_of arguments in
  let fits kind e = could_be kind (known_kind env e) in
  if List.for_all2 fits (List.filteri (fun i _ -> i < List.length es) kinds) es then
    let fault = Option.bind (Literal_check.all es) (Literal_check.fault operation) in
    Option.iter (fun fault -> error env Wrong_value at "%s" fault) fault

(* Its named arguments may be left out, but for those that are needed. *)
let geometry env at name ~required ~named ~needed arguments =
  let positional = List.filter (fun a -> not (is_named a)) arguments in
  let count = List.length positional and wanted = List.length required in
  if count <> wanted then
    error env Wrong_arity at "%s takes %s, not %d" name (number_of_arguments wanted wanted) count
  else List.iter2 (fun kind a -> check_kind env name kind (value_of a)) required positional;
  let check seen = function
    | Ast.Positional _ | Keyed _ -> seen
    | Named (k, e) ->
      (match List.assoc_opt k.Ast.it named with
       | None when named = [] -> error env Unknown_argument k.at "%s takes no argument by name" name
       | None ->
         error env Unknown_argument k.at "%s has no argument '%s'" name k.it
           ?hint:(did_you_mean k.it (List.map fst named))
       | Some _ when List.mem k.it seen -> error env Defined_twice k.at "%s has its argument '%s' twice" name k.it
       | Some kind -> check_kind env (Printf.sprintf "%s of %s" k.it name) kind e);
      k.it :: seen
  in
  let given = List.fold_left check [] arguments in
  let lacks k =
    error env Wrong_arity at "%s lacks its argument '%s'" name k ~hint:(Printf.sprintf "add %s: and a number" k)
  in
  List.iter (fun k -> if not (List.mem k given) then lacks k) needed;
  apply env at (Builtin (Geometry (name, keys_of arguments))) (values env arguments)

(* The value of an action's code is not used. *)
let rec warn_of_made_task env (body : Ast.statement list) =
  match List.rev body with
  | { it = Expression { it = Call { callee = { it = Variable "assert"; _ }; _ }; _ }; _ } :: _
    when not (is_hidden env "assert") -> ()
  | { it = Expression e; _ } :: _ when operand_kind env e = Task ->
    Scope.report env.program
      (Diagnostic.warning Unused_task e.at "this task is made but not executed: an action only runs its code"
         ~hint:"tasks follow each other by >>, as in action { ... } >> T; code in braces without action makes a task")
  | { it = If (_, yes, no); _ } :: _ -> warn_of_made_task env yes; warn_of_made_task env no
  | { it = Block body; _ } :: _ -> warn_of_made_task env body
  | _ -> ()

let rec to_builtin env at name (builtin : Builtins.t) arguments =
  match builtin.arguments with
  | Text_or { required; optional; operation } ->
    let these =
      match arguments with
      | [ Ast.Positional { it = Binary (Subtract, a, b); _ } ] when known_kind env a = Number ->
        error env Wrong_arity at "%s takes a latitude and a longitude: a ',' is missing" name
          ~hint:(Format.asprintf "write %s %a, -%a" name Dolphin_syntax.Print.expression a
                   Dolphin_syntax.Print.expression b);
        Builtins.These { required = [ Number ]; optional = []; operation }
      | [ Ast.Positional e ] when could_be String (known_kind env e) ->
        Builtins.These { required = [ String ]; optional = []; operation }
      | _ -> These { required; optional; operation }
    in
    to_builtin env at name { builtin with arguments = these } arguments
  | Geometry { required; named; needed } -> geometry env at name ~required ~named ~needed arguments
  | These { required; optional; operation } ->
    let count = List.length arguments and least = List.length required in
    let most = least + List.length optional in
    if count < least || count > most then
      error env Wrong_arity at "%s takes %s, not %d" name (number_of_arguments least most) count;
    let kinds = required @ optional in
    if operation = Time_of_day && arguments = [] then Scope.note_time_of_day env.program;
    if least <= count && count <= most then check_literals env at operation kinds arguments;
    let argument i a =
      (match a with
       | Ast.Named (k, _) -> error env Unknown_argument k.Ast.at "%s takes no argument by name" name
       | Ast.Positional e when operation = Make_idle && known_kind env e = Vehicles -> ()
       | Positional e | Keyed (_, e) -> if i < most then check_kind env name (List.nth kinds i) e);
      match value_of a with
      | { it = Closure c; at } when operation = Make_action || operation = Make_condition ->
        if operation = Make_action then warn_of_made_task env c.body;
        task_code env at name c
      | e -> elaborate env e
    in
    apply env at (Builtin operation) (List.mapi argument arguments)
  | Pairs construct -> Pairs.elaborate env at name construct arguments
  | Execute -> execute env at arguments
  | Set_connection_timeout -> set_connection_timeout env at arguments
  | Confirm -> confirm env at arguments
  | Input ->
    error env Misplaced_input at
      "input declares what the outside may post: it stands by itself at the top of the program";
    null env at
  | On_interrupt ->
    error env Misplaced_interrupt at
      "onInterrupt declares what an interruption executes: it stands by itself at the top of the program";
    null env at
  | Assert -> assertion_task env at arguments
  | Fresh -> fresh env at arguments

let builder_in_parentheses env at name arguments =
  let setting = function
    | Ast.Named (k, e) -> Format.asprintf "%s: %a" k.Ast.it Dolphin_syntax.Print.expression e
    | Positional e | Keyed (_, e) -> Format.asprintf "%a" Dolphin_syntax.Print.expression e
  in
  let hint =
    if arguments <> [] && List.for_all is_named arguments then
      Some (Printf.sprintf "write %s { %s }" name (String.concat "; " (List.map setting arguments)))
    else Option.map (fun example -> "write " ^ example) (Builtins.example_of_builder name)
  in
  error env ?hint Unknown_name at "the settings of %s stand in braces" name;
  null env at

let misspells_builder env name arguments =
  match List.rev arguments with
  | Ast.Positional { it = Closure _; _ } :: _ when not (Scope.is_assigned env.program name) -> (
      match Diagnostic.suggest name (Builtins.builder_names @ Scope.visible_names env.code) with
      | Some near -> List.mem near Builtins.builder_names
      | None -> false)
  | _ -> false

(* The page of its arguments is another one: near(v, 500.m) lacks the set that is searched. *)
let entry_in_prelude env name (lambda : lambda) =
  match Scope.location env.program lambda.lambda_site with
  | Some at when Location.file at = Prelude.file -> Prelude.find name
  | Some _ | None -> None

let by_name env at name (callee : Ast.expression) arguments =
  let called_value () =
    let callee = Names.variable env name callee.at in
    apply env at (Call (keys_of arguments)) (callee :: values env arguments)
  in
  match Scope.find_local env.code name, Scope.find_function env.program name, Builtins.find name with
  | Some _, _, _ -> called_value ()
  | None, Some lambda, _ ->
    let positional = List.filter (fun a -> not (is_named a)) arguments in
    let n = List.length positional + if List.length positional < List.length arguments then 1 else 0 in
    if n <> lambda.parameters then
      error env Wrong_arity at "%s takes %d argument%s, not %d" name lambda.parameters
        (if lambda.parameters = 1 then "" else "s")
        n ?hint:(Option.map (fun (e : Prelude.entry) -> "write " ^ e.form) (entry_in_prelude env name lambda))
    else
      Option.iter (fun entry -> Member_check.prelude_call env entry arguments) (entry_in_prelude env name lambda);
    Scope.note_call env.code name callee.at;
    called_value ()
  | None, None, Some _ when Builtins.is_geometry name && Scope.is_assigned env.program name -> called_value ()
  | None, None, Some builtin ->
    check_place env builtin name callee.at;
    to_builtin env at name builtin arguments
  | None, None, None when Chart_calls.is_call env.program name -> Chart_calls.elaborate env at arguments
  | None, None, None when name = fence && not (Scope.is_assigned env.program name) ->
    error env Bad_fence at
      "fence declares a limit that vehicles must keep: it stands by itself at the top of the program";
    null env at
  | None, None, None when name = locate && not (Scope.is_assigned env.program name) ->
    error env Misplaced_setting at
      "locate stands in imcPlan { ... }, or by itself at the top of the program for all plans without a place";
    null env at
  | None, None, None when List.mem name Builtins.builder_names -> builder_in_parentheses env callee.at name arguments
  | None, None, None when misspells_builder env name arguments ->
    (* The meaning of the block is unknown, so nothing in it is reported. *)
    error env Unknown_name callee.at "unknown name '%s'" name ?hint:(did_you_mean name Builtins.builder_names);
    null env at
  | None, None, None ->
    if Scope.settings env.code = None then Member_check.callee env callee arguments;
    (match Scope.settings env.code with
     | Some (((Pick | Recruit | Imc_plan | Mission | Pos) as builder), _) ->
       error env Unknown_setting callee.at "%s has no setting '%s'" (builder_name builder) name
         ?hint:(hint_for_setting builder name)
     | Some ((All_of | One_of), _) | None -> ());
    if Scope.settings env.code = None then called_value ()
    else apply env at Make_list (values env arguments)

let to_method env at subject name safe arguments =
  check_supplier env subject name;
  if not safe then Member_check.member env ~called:true ~arguments subject name;
  let looks_at_vehicle = arguments <> [] && (Travel.quantity name.Ast.it <> None || name.it = "rest") in
  if List.mem name.it sensor_members || looks_at_vehicle then Scope.note_sensor env.program;
  let keys = keys_of arguments in
  let on e = apply env at (Method (name.it, keys)) (e :: values env arguments) in
  if safe then unless_null env at (elaborate env subject) on
  else if Methods.updates name.it && Targets.is_path subject then begin
    (* An update assigns the new value to its subject, unless that is an object of the host. *)
    Targets.check_given env subject;
    let keep e =
      let slot = Scope.new_slot env.code in
      (set_local env at slot e, slot)
    in
    let first, receiver = keep (elaborate env subject) in
    let rest = List.map keep (values env arguments) in
    let again () =
      let arguments = List.map (fun (_, slot) -> local env at slot) rest in
      apply env at (Method (name.it, keys)) (local env at receiver :: arguments)
    in
    let is_host = apply env at (Builtin Is_host) [ local env at receiver ] in
    let on_host = again () in
    let updated = Targets.assign env at subject (again ()) in
    block env at ((first :: List.map fst rest) @ [ expression env at (If (is_host, on_host, updated)) ])
  end
  else on (elaborate env subject)

(* [count] is not a reserved name. *)
let counts env name arguments =
  name = "count" && arguments <> []
  && List.for_all (function Ast.Named _ | Keyed _ -> true | Positional _ -> false) arguments
  && not (is_hidden env name)

let takes_pairs env (callee : Ast.expression) arguments =
  match callee.it with
  | Variable name when counts env name arguments -> true
  | Variable name when not (is_hidden env name) -> (
      match Builtins.find name with Some { arguments = Pairs _; _ } -> true | Some _ | None -> false)
  | _ -> false

let call env at (callee : Ast.expression) arguments =
  let arguments = if takes_pairs env callee arguments then arguments else without_keys env arguments in
  match callee.it with
  | Variable name -> (
      match in_settings env name with
      | Some slot when Scope.find_local env.code name = None -> Setting_blocks.add env at slot name arguments
      | Some _ | None when counts env name arguments -> Pairs.elaborate env at name Count arguments
      | Some _ | None -> by_name env at name callee arguments)
  | Member { subject = { it = Variable "Math"; _ }; name; _ } when not (is_hidden env "Math") ->
    if not (Builtins.math name.it) then
      error env Unknown_name name.at "Math has no function '%s'" name.it
        ?hint:(did_you_mean name.it Builtins.math_names);
    apply env at (Builtin (Math name.it)) (values env arguments)
  | Member { subject; name; safe } -> to_method env at subject name safe arguments
  | _ ->
    Member_check.callee env callee arguments;
    let callee = elaborate env callee in
    apply env at (Call (keys_of arguments)) (callee :: values env arguments)
