open Core
open Checks

let wrong env ?hint at format = error env ?hint Wrong_value at format

let known_early = "the values of ensure are known when its task is made"

(* The first part of [e] whose value may change, or that may do something. *)
let rec check_value env (e : Ast.expression) =
  let refuse format = wrong env e.at ("%s: " ^^ format) known_early in
  let each = List.iter (check_value env) in
  let key (k, x) =
    (match (k : Ast.key Ast.located).it with Name _ -> () | Computed k -> check_value env k);
    check_value env x
  in
  match e.it with
  | Null | Boolean _ | Integer _ | Number _ | String _ | Wildcard -> ()
  | Template parts -> List.iter (function Ast.Literal _ -> () | Ast.Hole e -> check_value env e) parts
  | List es -> each es
  | Map entries -> List.iter key entries
  | Range { first; last; _ } -> each [ first; last ]
  | Variable x when Scope.find_local env.code x <> None || Scope.is_parameter env.program x -> ()
  | Variable x ->
    wrong env e.at "%s: '%s' is a global variable, which may change" known_early x
      ~hint:(Printf.sprintf
               "a function that makes the task takes it as a parameter: def f(%s) { return T ensure { ... } }" x)
  | Member { name; _ } when List.mem name.it sensor_members -> refuse "'%s' is a report of a vehicle" name.it
  | Unary (_, e) | Member { subject = e; _ } -> check_value env e
  | Binary ((Sequence | Parallel | Append), _, _) -> refuse "no task, and nothing that changes, is one of them"
  | Binary (_, a, b) | Elvis (a, b) | Index (a, b) -> each [ a; b ]
  | Conditional (a, b, c) -> each [ a; b; c ]
  | Closure _ -> refuse "code is not one of them"
  | Call _ -> refuse "a call is not one of them"
  | Increment _ | Builder _ | Pick_else _ | Recruit _ | When _ | Wait_for _ | Until _ | During _ | Watch _ | Ensure _
  | Repeat _ -> refuse "this is not one of them"

let value env e =
  check_value env e;
  Checks.elaborate env e

(* A pair, and the arguments that it takes. *)
let pair env (a : Ast.argument) =
  Pairs.check_key_of env a;
  match a with
  | Keyed (k, e) ->
    let k = value env k in
    Some (Pair_of None, [ k; value env e ])
  | Named (k, e) -> Some (Pair_of (Some k.it), [ value env e ])
  | Positional e ->
    wrong env e.at "post takes pairs of key and value here" ~hint:"write post key: value";
    None

let assigned env (x : string) at e =
  match Scope.find_local env.code x with
  | Some _ ->
    error env Captured_local at "'%s' is a local: ensure assigns global variables" x
      ~hint:"make it a global variable, without def";
    None
  | None ->
    Targets.check_assignable env x at;
    let e = value env e in
    Some (Variable_of (Scope.assigned_global env.program x, x), [ e ])

let nothing_else env at ~in_branch =
  let last = if in_branch then ", and giveBack()" else "" in
  wrong env at "ensure only posts pairs and assigns global variables: nothing in it can fail%s" last
    ~hint:"write post key: value, or x = value; anything else is an action { ... } before the end of the task";
  []

let statement env ~in_branch (s : Ast.statement) =
  match s.it with
  | Expression { it = Call { callee = { it = Variable "post"; _ }; arguments = _ :: _ as arguments }; _ }
    when not (is_hidden env "post") -> List.filter_map (pair env) arguments
  | Expression { it = Call { callee = { it = Variable name; _ }; arguments = [] }; at }
    when name = Dolphin_syntax.Print.give_back && not (is_hidden env name) ->
    if in_branch then [ (Taken_pairs, []) ]
    else begin
      wrong env at "giveBack() posts the pairs that the guard of a branch takes: no guard belongs to this task"
        ~hint:"the whole task of a branch may have it: waitFor { consume k: _ } then (T ensure { giveBack() })";
      []
    end
  | Assign { target = { it = Variable x; at }; operator = None; value = e } ->
    Option.to_list (assigned env x at e)
  | Expression _ | Assign _ | Define _ | Function _ | Parameter _ | If _ | While _ | For _ | Return _ | Break | Continue
  | Block _ | Setting _ -> nothing_else env s.at ~in_branch

let rec elaborate env at ~in_branch t (c : Ast.closure) =
  check_kind env "ensure" Task t;
  (match c.parameters with
   | Some (x :: _) -> error env Wrong_parameters x.at "the code of ensure takes no parameters"
   | Some [] | None -> ());
  let t = if in_branch then branch_operand env t else Closures.task_operand env t in
  let forms, arguments = List.split (List.concat_map (statement env ~in_branch) c.body) in
  apply env at (Builtin (Make_ensure forms)) (t :: List.concat arguments)

and branch_operand env (e : Ast.expression) =
  match e.it with
  | Ensure (t, c) -> elaborate env e.at ~in_branch:true t c
  | _ -> Closures.branch_operand env e
