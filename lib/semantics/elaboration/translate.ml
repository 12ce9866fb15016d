open Core
open Checks
open Closures

(* An error is also its text. *)
let members_of_text = [ "size"; "length"; "isEmpty"; "empty" ]

(* The construct that a [break] or [return] would leave half done. *)
let check_not_in_settings env at what =
  match Scope.settings env.code with
  | Some (builder, _) -> error env Misplaced_jump at "%s may not stand in %s { ... }" what (builder_name builder)
  | None -> ()

let warn_of_unused_task env (e : Ast.expression) =
  if Scope.at_top env.code && known_kind env e = Task && Scope.settings env.code = None then
    Scope.report env.program
      (Diagnostic.warning Unused_task e.at "this task is made but not executed"
         ~hint:"write execute before it, or give it a name")

let check_branch env (e : Ast.expression) =
  match Scope.settings env.code with
  | Some (((All_of | One_of) as builder), _) when operand_kind env e = Task ->
    let instead = if builder = All_of then "; tasks side by side are a | b" else "" in
    error env Wrong_kind e.at "%s takes branches, and this is a task" (builder_name builder)
      ~hint:("write when { CONDITION } then TASK" ^ instead)
  | Some _ | None -> ()

(* [xs.each { x -> when { C } then T }] among branches goes through them as [for (x in xs)] does: a closure of its own
   could not add any. *)
let each_of_branches env (e : Ast.expression) =
  let is_branch found (e : Ast.expression) = found || match e.it with When _ -> true | _ -> false in
  match Scope.settings env.code, e.it with
  | ( Some ((All_of | One_of), _),
      Call { callee = { it = Member { subject; name = { it = "each"; _ }; safe = false }; _ };
             arguments = [ Positional { it = Closure c; _ } ] } )
    when List.fold_left (Fold.statement is_branch) false c.body -> (
      (* An element without a name would be hidden in the code of when, whose own [it] is another. *)
      match c.parameters with
      | Some [ x ] -> Some (Ast.For (x, subject, c.body))
      | None | Some _ -> None)
  | _, _ -> None

(* [execute (a | b) >> c] executes all of [(a | b) >> c], and [region (a + b).offset(20)] in [pick] is that of the whole
   area: what has no value cannot be an operand, so the text after its parenthesis belongs to its argument. *)
let regroup env =
  regrouped ~is_procedure:(fun name ->
      not (is_hidden env name)
      && (in_settings env name <> None
          || match Builtins.find name with Some { result = Other; _ } -> true | Some _ | None -> false))

let check_index env (subject : Ast.expression) (index : Ast.expression) =
  (match subject.it with
   | Recruit _ ->
     Scope.report env.program
       (Diagnostic.warning No_effect index.at "this has no effect: recruit takes its vehicle itself"
          ~hint:"name the requested vehicle in its settings, as in recruit { id 'noptilus-1' } then { v -> T }")
   | _ -> ());
  let found = known_kind env index in
  if known_kind env subject = Task && not (could_be Vehicles found) then
    error env Wrong_kind index.at "between [ and ] after a task stands a vehicle set, this is %s"
      (Builtins.describe found)

(* Its arguments are constants: {!Fence_declarations} reads them. *)
let declares_fence env name =
  name = fence && (not (is_hidden env name)) && not (Scope.is_assigned env.program name)

(* So does {!Default_place}. *)
let declares_place env (e : Ast.expression) =
  match (Option.value (regrouped ~is_procedure:(String.equal locate) e) ~default:e).it with
  | Call { callee = { it = Variable name; _ }; _ } | Variable name ->
    name = locate && (not (is_hidden env name)) && not (Scope.is_assigned env.program name)
  | _ -> false

(* {1 Expressions} *)

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
    let part = function Ast.Literal s -> this (String s) | Ast.Hole e -> elaborate env e in
    apply env at Concatenate (List.map part parts)
  | Variable name -> Names.elaborate env name at
  | Wildcard ->
    error env Wildcard_value at "_ has no value: it stands for any value in consume and poll, for all vehicles in \
                                 count, and for no vehicles in execute";
    null env at
  | List es -> apply env at Make_list (List.map (elaborate env) es)
  | Map entries -> elaborate_map env at entries
  | Range { first; last; inclusive } -> apply env at (Make_range inclusive) (List.map (elaborate env) [ first; last ])
  | Closure c ->
    if env.answer then error env Deed_in_answer at "an answer may not contain code { ... }";
    closure env at Scope.Plain "closure" c
  | Unary (op, e) -> apply env at (Unary op) [ elaborate env e ]
  | Binary (And, a, b) -> condition env at a (fun () -> truth env b) (fun () -> this (Boolean false))
  | Binary (Or, a, b) -> condition env at a (fun () -> this (Boolean true)) (fun () -> truth env b)
  | Binary (Append, target, e) when Targets.is_path target ->
    Targets.update env at target (fun current -> apply env at (Binary Append) [ current; elaborate env e ])
  | Binary (Divide, t, { it = Closure c; at = closure_at }) ->
    let t = task_operand env t in
    apply env at (Binary Divide) [ t; task_code env closure_at "until" c ]
  | Binary (op, a, b) ->
    check_operator env op a b;
    let operand =
      match op, known_kind env a with
      | Sequence, _ | Parallel, (Task | Closure) -> task_operand env
      | Parallel, _ when confirmation env a <> None || confirmation env b <> None -> task_operand env
      | _, _ -> elaborate env
    in
    if check_subtraction env e then begin
      let a = operand a in
      apply env at (Binary op) [ a; operand b ]
    end
    else null env at
  | Conditional (test, yes, no) ->
    condition env at test (fun () -> elaborate env yes) (fun () -> elaborate env no)
  | Elvis (e, otherwise) -> elvis env at e otherwise
  | Increment { target; by; prefix } -> Targets.increment env at target by prefix
  | Call { callee; arguments } -> Calls.call env at callee arguments
  | Member { subject = { it = Variable error; _ }; name = { it = "message"; _ }; _ }
    when Scope.has_fields env.code error -> elaborate env { e with it = Variable error }
  | Member { subject = { it = Variable error; _ }; name = { it = ("vehicle" | "task") as field; _ }; _ }
    when Scope.has_fields env.code error -> elaborate env { e with it = Variable (Scope.field error field) }
  | Member { subject = { it = Variable error; _ }; name; _ }
    when Scope.has_fields env.code error && not (List.mem name.it members_of_text) ->
    Checks.error env Unknown_name name.at "an error has no property '%s'" name.it
      ~hint:(Printf.sprintf "%s.message is the error's text; %s.vehicle and %s.task have failed" error error error);
    null env at
  | Member { subject; name; safe } -> Names.member env e subject name safe
  | Index (subject, index) ->
    check_index env subject index;
    (match index.it with
     | String name -> Chart_calls.check_member env subject { it = name; at = index.at }
     | _ -> ());
    let subject = branch_operand env subject in
    apply env at Element [ subject; elaborate env index ]
  | Builder (builder, body) -> Setting_blocks.build env at builder body
  | Pick_else (settings, otherwise) -> pick_else env at settings otherwise
  | Recruit (settings, c) -> Setting_blocks.recruit env at settings c
  | When (guard, t) -> Setting_blocks.when_then env at guard t
  | Wait_for (guard, t) -> guarded env at Make_wait_for "waitFor" guard t
  | Until (Completes, guard, t) -> guarded env at (Make_until Completes) "until" guard t
  | Until (Fails, guard, t) -> assure env at guard t
  | During (on_cut, d, t) -> during env at on_cut d t
  | Watch (t, handler) -> watch env at t handler
  | Ensure (t, c) -> Ensures.elaborate env at ~in_branch:false t c
  | Repeat { rounds; body; until } -> repeat env at rounds body until

and truth env (e : Ast.expression) =
  apply env e.at (Unary Not) [ apply env e.at (Unary Not) [ elaborate env e ] ]

and condition env at test yes no =
  let test = elaborate env test in
  let yes = yes () in
  expression env at (If (test, yes, no ()))

and elvis env at e otherwise =
  let slot = Scope.new_slot env.code in
  let first = set_local env at slot (elaborate env e) in
  let test = apply env at (Builtin Is_there) [ local env at slot ] in
  let yes = local env at slot in
  expression env at (If (block env at [ first; test ], yes, elaborate env otherwise))

and pick_else env at settings otherwise =
  let slot = Scope.new_slot env.code in
  let picked = set_local env at slot (Setting_blocks.pick_if_any env at settings) in
  let yes = local env at slot in
  expression env at (If (picked, yes, body_of env at otherwise))

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

and guarded env at operation construct guard t =
  check_kind env construct Task t;
  let guard = task_code env at construct guard in
  let operand = if operation = Make_wait_for then Ensures.branch_operand else task_operand in
  apply env at (Builtin operation) [ guard; operand env t ]

and assure env at guard t =
  check_kind env "assure" Task t;
  let guard = told_code env at "assure" guard in
  apply env at (Builtin (Make_until Fails)) [ guard; task_operand env t ]

and during env at on_cut (d : Ast.expression) t =
  let word = Dolphin_syntax.Print.during on_cut in
  check_operand env word Task t;
  let d =
    match d.it with
    | Closure c -> task_code env d.at word c
    | _ ->
      check_operand env word Number d;
      Option.iter (fun fault -> error env Wrong_value d.at "%s" fault) (Literal_check.fault_of_time word d);
      elaborate env d
  in
  apply env at (Builtin (Make_during on_cut)) [ d; task_operand env t ]

and watch env at t (handler : Ast.closure) =
  check_kind env "watch" Task t;
  let t = task_operand env t in
  (match handler.parameters with
   | Some (_ :: second :: _) ->
     error env Wrong_parameters second.at "the code of onError takes one parameter, the error"
   | Some ([] | [ _ ]) | None -> ());
  apply env at (Builtin Make_watch) [ t; Closures.handler env at handler ]

and repeat env at rounds body until =
  let of_rounds (n : Ast.expression) =
    if known_kind env n = Task then
      error env Wrong_kind n.at "before the comma of repeat stands how many rounds there are, this is a task"
        ~hint:"put repeat and its task in parentheses, if the comma is not its own"
    else check_kind env "repeat" Number n;
    Option.iter (fun fault -> error env Wrong_value n.at "%s" fault) (Literal_check.fault_of_rounds n);
    elaborate env n
  in
  check_kind env "repeat" Task body;
  if rounds = None && until = None && never_waits env body then error env Wrong_value at "%s" Procedures.spins;
  if rounds = None then Scope.note_rounds env.program;
  let n = Option.map of_rounds rounds in
  let t = task_operand env body in
  let c = Option.map (task_code env at "repeat") until in
  let operation = Make_repeat { counted = rounds <> None; asked = until <> None } in
  apply env at (Builtin operation) (Option.to_list n @ [ t ] @ Option.to_list c)

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
    Calls.assertion env at arguments
  | Expression { it = Call { callee = { it = Variable "input"; _ }; arguments }; _ }
    when Scope.at_top env.code && not (is_hidden env "input") ->
    Calls.input env at arguments
  | Expression { it = Call { callee = { it = Variable name; _ }; _ } | Variable name; _ }
    when Scope.at_top env.code && declares_fence env name -> null env at
  | Expression e when Scope.at_top env.code && declares_place env e -> null env at
  | Expression ({ it = Call { arguments; _ }; _ } as e)
    when Scope.may_give_task env.code && confirmation env e <> None -> confirm_task env at arguments
  | Expression e when each_of_branches env e <> None ->
    let desugared = Option.value (each_of_branches env e) ~default:s.it in
    statement env { s with it = desugared }
  | Expression e ->
    let e = Option.value (regroup env e) ~default:e in
    (match e.it with
     | Call { callee = { it = Variable "onInterrupt"; _ }; arguments }
       when Scope.at_top env.code && not (is_hidden env "onInterrupt") ->
       Calls.on_interrupt env at arguments
     | _ ->
       warn_of_unused_task env e;
       check_branch env e;
       elaborate env e)
  | Assign { target; operator = None; value } ->
    check_no_setting env target value;
    Targets.assign env at target (elaborate env value)
  | Assign { target; operator = Some op; value } ->
    Targets.update env at target (fun current -> apply env at (Binary op) [ current; elaborate env value ])
  | Define (name, value) ->
    let e = match value with Some e -> elaborate env e | None -> null env at in
    if Scope.at_top env.code then Targets.assign_variable env at name.it name.at e
    else set_local env at (Scope.define env.code name.it) e
  | Parameter { name; value; description = _ } ->
    let e = elaborate env value in
    if not (Scope.at_top env.code) then
      error env Misplaced_parameter name.at "parameters stand at the top of the program, not inside of a block"
    else if not (Dolphin_syntax.Parameters.is_value value) then
      error env Wrong_value value.at "the value of a parameter is a number, a text, true, false, null, a place, or a \
                                      list or map of these"
        ~hint:(Printf.sprintf "for a computed value: %s = ..." name.it);
    Targets.set_global env at name.it e
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
  | Setting (name, e) -> Setting_blocks.setting env at name e

let env program code ~answer = { program; code; answer; of_expression = elaborate; of_statements = statements }
