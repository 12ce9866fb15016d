open Core
open Checks

let variable env (name : string) at =
  match Scope.find_local env.code name with
  | Some (Own slot | Captured slot) -> local env at slot
  | None -> (
      match Scope.find_function env.program name with
      | Some lambda -> constant env at (Closure { lambda; captured = [||] })
      | None -> expression env at (Global (Scope.used_global env.program name at)))

(* What a [break] or [return] would leave half done. *)
let check_not_in_settings env at what =
  match Scope.settings env.code with
  | Some (builder, _) -> error env Misplaced_jump at "%s may not stand in %s { ... }" what (builder_name builder)
  | None -> ()

(* [execute (a | b) >> c] executes all of [(a | b) >> c]: a procedure that gives nothing is no operand, so what follows
   its parenthesis belongs to its argument. *)
let rec regroup env (e : Ast.expression) : Ast.expression option =
  let around first rebuild =
    match regroup env first with
    | Some ({ it = Call { callee; arguments = [ Positional argument ] }; _ } as whole) ->
      let argument = { e with it = rebuild argument } in
      Some { whole with it = Ast.Call { callee; arguments = [ Ast.Positional argument ] } }
    | Some _ | None -> None
  in
  match e.it with
  | Call { callee = { it = Variable name; _ }; arguments = [ Positional _ ] } when not (is_hidden env name) -> (
      match Builtins.find name with Some { result = Other; _ } -> Some e | Some _ | None -> None)
  | Binary (op, first, second) -> around first (fun first -> Ast.Binary (op, first, second))
  | Index (first, index) -> around first (fun first -> Ast.Index (first, index))
  | _ -> None

let rec elaborate env (e : Ast.expression) : expression =
  let at = e.at in
  let this x = constant env at x in
  match e.it with
  | Null -> this Null
  | Boolean b -> this (Boolean b)
  | Integer i -> this (Integer i)
  | Number n -> this (Number n)
  | String s -> this (String s)
  | Template parts ->
    let part = function
      | Ast.Literal s -> constant env at (String s)
      | Ast.Hole e -> elaborate env e
    in
    apply env at Concatenate (List.map part parts)
  | Variable name -> elaborate_name env name at
  | Wildcard ->
    error env Wildcard_value at "_ has no value: it stands for any value in consume and poll, for all vehicles in \
                                 count, and for no vehicles in execute";
    null env at
  | List es -> apply env at Make_list (List.map (elaborate env) es)
  | Map entries -> elaborate_map env at entries
  | Range { first; last; inclusive } ->
    let first = elaborate env first in
    apply env at (Make_range inclusive) [ first; elaborate env last ]
  | Closure c ->
    if env.answer then error env Deed_in_answer at "an answer may not contain code { ... }";
    closure env at Scope.Plain "closure" c
  | Unary (op, e) -> apply env at (Unary op) [ elaborate env e ]
  | Binary (And, a, b) -> condition env at a (fun () -> truth env b) (fun () -> this (Boolean false))
  | Binary (Or, a, b) -> condition env at a (fun () -> this (Boolean true)) (fun () -> truth env b)
  | Binary (Append, target, e) when is_path target ->
    update env at target (fun current -> apply env at (Binary Append) [ current; elaborate env e ])
  | Binary (Divide, t, { it = Closure c; at = closure_at }) ->
    let t = elaborate env t in
    apply env at (Binary Divide) [ t; task_code env closure_at "until" c ]
  | Binary (op, a, b) ->
    check_operator env op a b;
    let a = elaborate env a in
    apply env at (Binary op) [ a; elaborate env b ]
  | Conditional (test, yes, no) ->
    condition env at test (fun () -> elaborate env yes) (fun () -> elaborate env no)
  | Elvis (e, otherwise) ->
    let slot = Scope.new_slot env.code in
    let first = set_local env at slot (elaborate env e) in
    let test = local env at slot in
    let yes = local env at slot in
    expression env at (If (block env at [ first; test ], yes, elaborate env otherwise))
  | Increment { target; by; prefix } -> increment env at target by prefix
  | Call { callee; arguments } -> call env at callee arguments
  | Member { subject; name; safe } -> member env e subject name safe
  | Index (subject, index) ->
    if known_kind env subject = Task && not (could_be Vehicles (known_kind env index)) then
      error env Wrong_kind index.at "between [ and ] after a task stands a vehicle set, this is %s"
        (Builtins.describe (known_kind env index));
    let subject = elaborate env subject in
    apply env at Element [ subject; elaborate env index ]
  | Builder (builder, body) -> build env at builder body
  | When (guard, t) -> when_then env at guard t
  | Wait_for (guard, t) -> guarded env at Make_wait_for "waitFor" guard t
  | Until (guard, t) -> guarded env at Make_until "until" guard t
  | During (d, t) ->
    check_kind env "during" Task t;
    let d =
      match d.it with
      | Closure c -> task_code env d.at "during" c
      | _ ->
        check_kind env "during" Number d;
        elaborate env d
    in
    apply env at (Builtin Make_during) [ d; elaborate env t ]
  | Watch (t, handler) ->
    check_kind env "watch" Task t;
    let t = elaborate env t in
    (match handler.parameters with
     | Some (_ :: second :: _) ->
       error env Wrong_parameters second.at "the code of onError takes one parameter, the error"
     | Some ([] | [ _ ]) | None -> ());
    apply env at (Builtin Make_watch) [ t; closure env at Scope.Handler "onError" handler ]

and truth env (e : Ast.expression) =
  apply env e.at (Unary Not) [ apply env e.at (Unary Not) [ elaborate env e ] ]

and condition env at test yes no =
  let test = elaborate env test in
  let yes = yes () in
  expression env at (If (test, yes, no ()))

and elaborate_name env name at =
  match in_settings env name with
  | Some slot when not (is_hidden env name) -> add_setting env at slot name []
  | Some _ | None ->
    if List.mem name Builtins.owners && not (is_hidden env name) then begin
      error env No_value at "'%s' is not a value by itself" name
        ~hint:(Printf.sprintf "write one of %s"
                 (String.concat ", " (List.filter (fun c -> root c = name) Builtins.constants)));
      null env at
    end
    else if Builtins.find name <> None && not (is_hidden env name) then begin
      error env No_value at "'%s' is a procedure: it needs its arguments" name
        ~hint:(Printf.sprintf "write %s(...)" name);
      null env at
    end
    else variable env name at

and elaborate_map env at entries =
  let key (k : Ast.key Ast.located) = match k.it with Name name -> Some name | Computed _ -> None in
  let parts ((k : Ast.key Ast.located), e) =
    match k.it with
    | Name _ -> [ elaborate env e ]
    | Computed computed ->
      let computed = elaborate env computed in
      [ computed; elaborate env e ]
  in
  apply env at (Make_map (List.map (fun (k, _) -> key k) entries)) (List.concat_map parts entries)

and member env (whole : Ast.expression) subject name safe =
  let at = whole.at in
  match dotted whole with
  | Some full when List.mem (root full) Builtins.owners && not (is_hidden env (root full)) -> (
      match Builtins.constant full with
      | Some x -> constant env at x
      | None ->
        error env Unknown_name at "there is no '%s'" full ?hint:(did_you_mean full Builtins.constants);
        null env at)
  | Some _ | None ->
    if List.mem name.it sensor_members then Scope.note_sensor env.program;
    (match kind_of subject with
     | Number when Operators.unit_factor name.it = None ->
       error env Unknown_unit name.at "there is no unit '%s'" name.it ?hint:(did_you_mean name.it Operators.unit_names)
     | _ -> ());
    let subject = elaborate env subject in
    if safe then unless_null env at subject (fun e -> apply env at (Property name.it) [ e ])
    else apply env at (Property name.it) [ subject ]

and unless_null env at subject f =
  let slot = Scope.new_slot env.code in
  let first = set_local env at slot subject in
  let is_null = apply env at (Binary Equal) [ local env at slot; null env at ] in
  let rest = f (local env at slot) in
  block env at [ first; expression env at (If (is_null, null env at, rest)) ]

(* {2 Closures} *)

and make_lambda env at purpose label ~parameters ~implicit body =
  let code = Scope.code env.program purpose (Some env.code) in
  let inside = { env with code } in
  List.iter (fun (x : string Ast.located) -> ignore (Scope.define code x.it)) parameters;
  let lambda =
    {
      id = Scope.fresh_lambda_id env.program;
      label;
      parameters = List.length parameters;
      implicit;
      captures = [||];
      slots = 0;
      code = null env at;
      lambda_site = Scope.site env.program at;
    }
  in
  lambda.code <- body inside at;
  lambda.captures <- Array.of_list (List.map snd (Scope.captures code));
  lambda.slots <- Scope.slots code;
  (lambda, List.map fst (Scope.captures code))

and closure env at purpose label (c : Ast.closure) =
  let implicit = c.parameters = None in
  let parameters =
    match c.parameters with Some parameters -> parameters | None -> [ { Ast.it = "it"; at } ]
  in
  let body env at = statements env at c.body in
  let lambda, captured = make_lambda env at purpose label ~parameters ~implicit body in
  expression env at (Make_closure (lambda, captured))

and task_code env at construct (c : Ast.closure) =
  (match c.parameters with
   | Some (first :: _) -> error env Wrong_parameters first.Ast.at "the code of %s takes no parameters" construct
   | Some [] | None -> ());
  closure env at (Scope.Task_code construct) construct c

and guarded env at operation construct guard t =
  check_kind env construct Task t;
  let guard = task_code env at construct guard in
  apply env at (Builtin operation) [ guard; elaborate env t ]

(* {2 Blocks of settings} *)

and build env at builder body =
  if builder = Pick then check_place env { (Option.get (Builtins.find "ask")) with result = Vehicles } "pick" at;
  check_repeated env builder body;
  let slot = Scope.new_slot env.code in
  let start = set_local env at slot (constant env at (Settings [])) in
  let body =
    Scope.in_block env.code (fun () ->
        Scope.inside_settings env.code (Some (builder, slot)) (fun () -> statements env at body))
  in
  let name = Printf.sprintf "plan-%d" (Location.line at) in
  block env at [ start; body; apply env at (Build (builder, name)) [ local env at slot ] ]

and add_setting env at slot name arguments =
  let outside f = Scope.inside_settings env.code None f in
  let argument = function
    | Ast.Positional { Ast.it = Wildcard; at } when name = "count" -> constant env at Wildcard
    | argument -> elaborate env (value_of argument)
  in
  let arguments' = outside (fun () -> List.map argument arguments) in
  (match Scope.settings env.code with
   | Some (Imc_plan, _) -> check_named_settings env name arguments
   | Some ((Pick | Pos | All_of | One_of), _) | None ->
     List.iter
       (function
         | Ast.Named (k, _) -> error env Unknown_argument k.Ast.at "'%s' takes no argument by name" name
         | Ast.Positional _ -> ())
       arguments);
  set_local env at slot
    (apply env at (Add_setting (name, keys_of arguments)) (local env at slot :: arguments'))

and check_named_settings env name arguments =
  let allowed = Option.value (List.assoc_opt name Plan_builder.vocabulary) ~default:[] in
  List.iter
    (function
      | Ast.Named (k, _) when not (List.mem k.Ast.it allowed) ->
        error env Unknown_argument k.Ast.at "'%s' has no argument '%s'" name k.Ast.it
          ?hint:(did_you_mean k.Ast.it allowed)
      | Ast.Named _ | Ast.Positional _ -> ())
    arguments

and when_then env at guard t =
  match Scope.settings env.code with
  | Some ((All_of | One_of), slot) ->
    check_kind env "then" Task t;
    Scope.inside_settings env.code None (fun () ->
        let guard = task_code env at "when" guard in
        let t = elaborate env t in
        set_local env at slot (apply env at Make_branch [ local env at slot; guard; t ]))
  | Some ((Pick | Imc_plan | Pos), _) | None ->
    error env Misplaced_when at "when { ... } then belongs in allOf { ... } or oneOf { ... }"
      ~hint:"a task that waits for one condition is waitFor { ... } then TASK";
    null env at

(* {2 Calls} *)

and call env at (callee : Ast.expression) arguments =
  match callee.it with
  | Variable name -> (
      match in_settings env name with
      | Some slot when Scope.find_local env.code name = None -> add_setting env at slot name arguments
      | Some _ | None -> call_by_name env at name callee arguments)
  | Member { subject = { it = Variable "Math"; _ }; name; _ } when not (is_hidden env "Math") ->
    if not (Builtins.math name.it) then
      error env Unknown_name name.at "Math has no function '%s'" name.it
        ?hint:(did_you_mean name.it Builtins.math_names);
    apply env at (Builtin (Math name.it)) (List.map (fun a -> elaborate env (value_of a)) arguments)
  | Member { subject; name; safe } -> call_method env at subject name safe arguments
  | _ ->
    let callee = elaborate env callee in
    apply env at (Call (keys_of arguments)) (callee :: List.map (fun a -> elaborate env (value_of a)) arguments)

and call_by_name env at name callee arguments =
  let called_value () =
    let callee = variable env name callee.at in
    apply env at (Call (keys_of arguments)) (callee :: List.map (fun a -> elaborate env (value_of a)) arguments)
  in
  match Scope.find_local env.code name, Scope.find_function env.program name, Builtins.find name with
  | Some _, _, _ -> called_value ()
  | None, Some lambda, _ ->
    let positional = List.filter (function Ast.Positional _ -> true | Ast.Named _ -> false) arguments in
    let n = List.length positional + if List.length positional < List.length arguments then 1 else 0 in
    if n <> lambda.parameters then
      error env Wrong_arity at "%s takes %d argument%s, not %d" name lambda.parameters
        (if lambda.parameters = 1 then "" else "s")
        n;
    Scope.note_call env.code name callee.at;
    called_value ()
  | None, None, Some builtin ->
    check_place env builtin name callee.at;
    call_builtin env at name builtin arguments
  | None, None, None ->
    (match Scope.settings env.code with
     | Some (((Pick | Imc_plan | Pos) as builder), _) ->
       error env Unknown_setting callee.at "%s has no setting '%s'" (builder_name builder) name
         ?hint:(did_you_mean name (Builtins.settings builder))
     | Some ((All_of | One_of), _) | None -> ());
    if Scope.settings env.code = None then called_value ()
    else apply env at Make_list (List.map (fun a -> elaborate env (value_of a)) arguments)

and call_builtin env at name (builtin : Builtins.t) arguments =
  match builtin.arguments with
  | These { required; optional; operation } ->
    let count = List.length arguments and least = List.length required in
    let most = least + List.length optional in
    if count < least || count > most then
      error env Wrong_arity at "%s takes %s, not %d" name (number_of_arguments least most) count;
    let kinds = required @ optional in
    let argument i a =
      (match a with
       | Ast.Named (k, _) -> error env Unknown_argument k.Ast.at "%s takes no argument by name" name
       | Ast.Positional e -> if i < most then check_kind env name (List.nth kinds i) e);
      match value_of a with
      | { it = Closure c; at } when operation = Make_action || operation = Make_condition -> task_code env at name c
      | e -> elaborate env e
    in
    apply env at (Builtin operation) (List.mapi argument arguments)
  | Pairs operation -> pairs env at name operation arguments
  | Pairs_or_key operation -> (
      match arguments with
      | [ Ast.Positional e ] ->
        check_kind env name String e;
        apply env at (Builtin (operation [])) [ elaborate env e ]
      | arguments -> pairs env at name operation arguments)
  | Execute -> execute env at arguments
  | Set_connection_timeout -> set_connection_timeout env at arguments
  | Assert -> assertion_task env at arguments

(* [if (!C()) ...]: the text is computed only if the condition does not hold. *)
and assertion env at arguments =
  let not_code at =
    error env Wrong_kind at "assert takes code { ... } that says what holds" ~hint:"write assert { CONDITION }, 'TEXT'"
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
  | Ast.Positional first :: _ :: _ :: _ ->
    error env Wrong_arity first.at "assert takes code and a text, not %d arguments" (List.length arguments);
    null env at
  | [ _; Ast.Named (k, _) ] -> error env Unknown_argument k.at "assert takes no argument by name"; null env at
  | (Ast.Positional { at = first; _ } | Ast.Named (_, { at = first; _ })) :: _ -> not_code first; null env at
  | [] -> not_code at; null env at

(* As an operand, an assertion is a task: [action { assert { C }, TEXT }]. *)
and assertion_task env at arguments =
  let body env at = assertion env at arguments in
  let lambda, captured = make_lambda env at (Scope.Task_code "assert") "assert" ~parameters:[] ~implicit:false body in
  apply env at (Builtin Make_action) [ expression env at (Make_closure (lambda, captured)) ]

and number_of_arguments least most =
  match least, most with
  | 0, 0 -> "no arguments"
  | 1, 1 -> "1 argument"
  | least, most when least = most -> Printf.sprintf "%d arguments" least
  | least, most -> Printf.sprintf "%d to %d arguments" least most

and pairs env at name operation arguments =
  let value = function
    | Ast.Named (k, { it = Wildcard; at }) when name <> "post" ->
      if name = "consume" then Scope.note_ordered_key env.program k.Ast.it;
      constant env at Wildcard
    | Ast.Named (_, e) -> elaborate env e
    | Ast.Positional e ->
      error env No_pairs e.at "%s takes pairs of key and value" name
        ~hint:(Printf.sprintf "write %s key: value" name);
      elaborate env e
  in
  let keys = List.filter_map (function Ast.Named (k, _) -> Some k.Ast.it | Ast.Positional _ -> None) arguments in
  if arguments = [] then
    error env No_pairs at "%s takes pairs of key and value" name ~hint:(Printf.sprintf "write %s key: value" name);
  apply env at (Builtin (operation keys)) (List.map value arguments)

and execute env at arguments =
  match arguments with
  | [ Ast.Positional e ] ->
    check_kind env "execute" Task e;
    apply env at (Builtin Execute) [ elaborate env e ]
  | _ :: _ when List.for_all (function Ast.Named _ -> true | Ast.Positional _ -> false) arguments ->
    let part = function
      | Ast.Named ({ it = "_"; _ }, e) -> [ elaborate env e ]
      | Ast.Named (k, e) ->
        check_kind env "execute" Task e;
        let vehicles = elaborate_name env k.it k.at in
        [ vehicles; elaborate env e ]
      | Ast.Positional e -> [ elaborate env e ]
    in
    let names = List.filter_map (function Ast.Named (k, _) -> Some k.Ast.it | Ast.Positional _ -> None) arguments in
    apply env at (Builtin (Execute_for names)) (List.concat_map part arguments)
  | _ ->
    error env Wrong_arity at "execute takes one task, or tasks by the vehicles that run them"
      ~hint:"write execute T, or execute v1: T1, v2: T2";
    null env at

and set_connection_timeout env at arguments =
  match arguments with
  | [ Ast.Positional e ] ->
    check_kind env "setConnectionTimeout" Number e;
    apply env at (Builtin Set_connection_timeout) [ elaborate env e ]
  | [ Ast.Positional v; Ast.Positional e ] ->
    check_kind env "setConnectionTimeout" Vehicles v;
    check_kind env "setConnectionTimeout" Number e;
    let v = elaborate env v in
    apply env at (Builtin Set_connection_timeout) [ v; elaborate env e ]
  | _ :: _ when List.for_all (function Ast.Named _ -> true | Ast.Positional _ -> false) arguments ->
    let one = function
      | Ast.Named (k, e) ->
        check_kind env "setConnectionTimeout" Number e;
        let v = elaborate_name env k.it k.at in
        apply env at (Builtin Set_connection_timeout) [ v; elaborate env e ]
      | Ast.Positional e -> elaborate env e
    in
    block env at (List.map one arguments)
  | _ ->
    error env Wrong_arity at "setConnectionTimeout takes a time, or vehicles and a time"
      ~hint:"write setConnectionTimeout v1, 2.min";
    null env at

and call_method env at subject name safe arguments =
  if List.mem name.Ast.it sensor_members then Scope.note_sensor env.program;
  let values () = List.map (fun a -> elaborate env (value_of a)) arguments in
  let keys = keys_of arguments in
  let on e = apply env at (Method (name.it, keys)) (e :: values ()) in
  if safe then unless_null env at (elaborate env subject) on
  else if Methods.updates name.it && is_path subject then begin
    (* An update assigns the new value to what it was called on, unless that is an object of the host. *)
    let keep e =
      let slot = Scope.new_slot env.code in
      (set_local env at slot e, slot)
    in
    let first, receiver = keep (elaborate env subject) in
    let rest = List.map keep (values ()) in
    let again () =
      let arguments = List.map (fun (_, slot) -> local env at slot) rest in
      apply env at (Method (name.it, keys)) (local env at receiver :: arguments)
    in
    let is_host = apply env at (Builtin Is_host) [ local env at receiver ] in
    let on_host = again () in
    let updated = assign env at subject (again ()) in
    block env at ((first :: List.map fst rest) @ [ expression env at (If (is_host, on_host, updated)) ])
  end
  else on (elaborate env subject)

(* {2 Assignment} *)

(* What an assignment may name: a variable, or an element or member of what may be assigned. *)
and is_path (e : Ast.expression) =
  match e.it with
  | Variable _ -> true
  | Index (e, _) | Member { subject = e; safe = false; _ } -> is_path e
  | _ -> false

and assign env at (target : Ast.expression) e =
  match target.it with
  | Variable name -> assign_variable env at name target.at e
  | Index (subject, index) ->
    let slot = Scope.new_slot env.code in
    let keep = set_local env at slot e in
    let current = elaborate env subject in
    let index = elaborate env index in
    let replaced = apply env at Replace_element [ current; index; local env at slot ] in
    block env at [ keep; assign env at subject replaced; local env at slot ]
  | Member { subject; name; _ } ->
    let slot = Scope.new_slot env.code in
    let keep = set_local env at slot e in
    let current = elaborate env subject in
    let replaced = apply env at (Replace_member name.it) [ current; local env at slot ] in
    block env at [ keep; assign env at subject replaced; local env at slot ]
  | _ ->
    error env Not_assignable target.at "this cannot be assigned to"
      ~hint:"assign to a variable, an element or a member";
    e

and assign_variable env at name name_at e =
  match Scope.find_local env.code name with
  | Some (Own slot) -> set_local env at slot e
  | Some (Captured _) ->
    error env Captured_local name_at
      "'%s' is a local of the code around: a closure has a copy of it and cannot assign it" name
      ~hint:"make it a global variable, without def";
    e
  | None ->
    if Scope.find_function env.program name <> None then
      error env Not_assignable name_at "'%s' is a function and cannot be assigned" name
    else if Builtins.find name <> None || List.mem name Builtins.owners then
      error env Not_assignable name_at "'%s' is a name of the language and cannot be assigned" name
        ~hint:"choose another name";
    expression env at (Set_global (Scope.assigned_global env.program name, e))

and update env at target f = assign env at target (f (elaborate env target))

and increment env at target by prefix =
  let one = constant env at (Integer (abs by)) in
  let op : Ast.binary = if by > 0 then Add else Subtract in
  if prefix then update env at target (fun current -> apply env at (Binary op) [ current; one ])
  else begin
    let slot = Scope.new_slot env.code in
    let keep = set_local env at slot (elaborate env target) in
    let added = apply env at (Binary op) [ local env at slot; one ] in
    block env at [ keep; assign env at target added; local env at slot ]
  end

(* {1 Statements} *)

and statements env at body =
  match body with
  | [] -> null env at
  | body -> block env at (List.map (statement env) body)

and body_of env at body = Scope.in_block env.code (fun () -> statements env at body)

and statement env (s : Ast.statement) : expression =
  let at = s.at in
  match s.it with
  | Expression { it = Call { callee = { it = Variable "assert"; _ }; arguments }; _ }
    when not (is_hidden env "assert") ->
    assertion env at arguments
  | Expression e ->
    check_subtraction env e;
    let e = Option.value (regroup env e) ~default:e in
    if Scope.at_top env.code && known_kind env e = Task && Scope.settings env.code = None then
      Scope.report env.program
        (Diagnostic.warning Unused_task e.at "this task is made but not executed"
           ~hint:"write execute before it, or give it a name");
    elaborate env e
  | Assign { target; operator = None; value } -> assign env at target (elaborate env value)
  | Assign { target; operator = Some op; value } ->
    update env at target (fun current -> apply env at (Binary op) [ current; elaborate env value ])
  | Define (name, value) ->
    let e = match value with Some e -> elaborate env e | None -> null env at in
    if Scope.at_top env.code then assign_variable env at name.it name.at e
    else set_local env at (Scope.define env.code name.it) e
  | Function { name; _ } ->
    if not (Scope.at_top env.code) then
      error env Misplaced_function name.at "functions are defined at the top of the program, not inside of a block"
        ~hint:(Printf.sprintf "write def %s = { ... } for a closure" name.it);
    null env at
  | If (test, yes, no) ->
    condition env at test (fun () -> body_of env at yes) (fun () -> body_of env at no)
  | While (test, body) ->
    let test = elaborate env test in
    expression env at (While (test, Scope.inside_loop env.code (fun () -> body_of env at body)))
  | For (name, range, body) ->
    let range = elaborate env range in
    Scope.in_block env.code (fun () ->
        let slot = Scope.define env.code name.it in
        let body = Scope.inside_loop env.code (fun () -> body_of env at body) in
        expression env at (For (slot, range, body)))
  | Return value ->
    check_not_in_settings env at "return";
    expression env at (Return (match value with Some e -> elaborate env e | None -> null env at))
  | Break | Continue ->
    if not (Scope.in_loop env.code) then
      error env Misplaced_jump at "%s stands outside of a loop" (if s.it = Break then "break" else "continue");
    expression env at (if s.it = Break then Break else Continue)
  | Block body -> body_of env at body
  | Setting (name, e) -> (
      match Scope.settings env.code, in_settings env name.it with
      | _, Some slot -> add_setting env at slot name.it [ Ast.Positional e ]
      | Some (builder, _), None ->
        error env Unknown_setting name.at "%s has no setting '%s'" (builder_name builder) name.it
          ?hint:(did_you_mean name.it (Builtins.settings builder));
        null env at
      | None, None ->
        error env Misplaced_setting name.at "'%s:' stands outside of a block of settings" name.it
          ~hint:(Printf.sprintf "an assignment is %s = ..." name.it);
        null env at)
