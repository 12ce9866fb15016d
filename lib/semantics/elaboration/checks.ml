module Ast = Dolphin_syntax.Ast
module Location = Dolphin_syntax.Location
module Diagnostic = Dolphin_syntax.Diagnostic
open Core

type env = {
  program : Scope.program;
  code : Scope.code;
  answer : bool;
  of_expression : env -> Ast.expression -> expression;
  of_statements : env -> Location.t -> Ast.statement list -> expression;
}

let elaborate env e = env.of_expression env e
let statements env at body = env.of_statements env at body
let expression env at node = { node; site = Scope.site env.program at }
let constant env at x = expression env at (Constant x)
let apply env at operation arguments = expression env at (Apply (operation, arguments))
let block env at = function [ e ] -> e | es -> expression env at (Block es)
let local env at slot = expression env at (Local slot)
let set_local env at slot e = expression env at (Set_local (slot, e))

let error env ?hint code at format =
  Printf.ksprintf (fun message -> Scope.report env.program (Diagnostic.error ?hint ~code at message)) format

let null env at = constant env at Null

let unless_null env at subject f =
  let slot = Scope.new_slot env.code in
  let first = set_local env at slot subject in
  let is_null = apply env at (Binary Equal) [ local env at slot; null env at ] in
  let rest = f (local env at slot) in
  block env at [ first; expression env at (If (is_null, null env at, rest)) ]

let did_you_mean name names =
  Option.map (Printf.sprintf "did you mean '%s'?") (Diagnostic.suggest name names)

(* The original language sends messages of MAVLink by it. *)
let sends_message = "sendMessage"

let hint_for_message =
  "programs send vehicles no messages: write an order as an item of mission { ... }, or part of a stored one: \
   stored 'name'"

let hint_for_recruit =
  "it takes one vehicle, and waits without limit: recruit { ... } then { v -> T } within 10.minutes limits the time"

let hint_for_setting builder name =
  if builder = Ast.Mission && name = sends_message then Some hint_for_message
  else if builder = Ast.Mission && name = "moveAndLoiterTurns" then
    Some "turns are an argument here: moveAndLoiter 50, 0, turns: 3"
  else if builder = Ast.Mission && name = "land" then Some "as in landingPoint p, or returnHomeAndLand()"
  else if builder = Ast.Imc_plan && name = "surveyArea" then
    Some
      "surveyArea is an item of mission { ... }; in a plan, for (p in coverage(area, spacing: 20.m)) goTo location: p"
  else if builder = Ast.Recruit && List.mem name (Builtins.settings Pick) then Some hint_for_recruit
  else if builder = Ast.Imc_plan && name = "depth" then Some "a depth is z 3, Z.Units.DEPTH"
  else
    match did_you_mean name (Builtins.settings builder) with
    | Some hint -> Some hint
    | None when builder = Ast.Imc_plan && List.mem name (Builtins.settings Mission) ->
      Some (Printf.sprintf "%s is an item of mission { ... }" name)
    | None -> None

(* {1 What is known of an expression before it runs} *)

let kind_of_vehicles : string -> Builtins.kind = function
  | "battery" -> Number
  | "position" -> Position
  | "id" | "type" -> String
  | "first" | "last" | "head" | "tail" -> Vehicles
  | _ -> Any

let rec kind_by variable (e : Ast.expression) : Builtins.kind =
  let kind_of = kind_by variable in
  match e.it with
  | Variable name -> variable name
  | Integer _ | Number _ -> Number
  | String _ | Template _ -> String
  | Closure _ -> Closure
  | Builder ((Imc_plan | Mission | All_of | One_of | Recruit), _) | Recruit _ | Wait_for _ | Until _ | During _
  | Watch _ | Ensure _
  | Repeat _ -> Task
  | Builder (Pick, _) -> Vehicles
  | Builder (Pos, _) -> Position
  | Boolean _ | Unary (Not, _)
  | Binary ((And | Or | Equal | Not_equal | Less | Less_equal | Greater | Greater_equal | Member_of), _, _) -> Truth
  | Null | List _ | Map _ | Range _ -> Other
  | Member { subject; name; safe = false } when kind_of subject = Number && Operators.unit_factor name.it <> None ->
    Number
  | Member { subject; name; safe = false } when kind_of subject = Vehicles -> kind_of_vehicles name.it
  | Index (a, _) when kind_of a = Vehicles -> Vehicles
  | Unary (Negate, e) -> kind_of e
  | Binary ((Sequence | Parallel | Divide), a, _) when kind_of a = Task -> Task
  | Binary ((Sequence | Parallel | Divide), { it = Call { callee = { it = Variable "confirm"; _ }; _ }; _ }, _)
  | Index ({ it = Call { callee = { it = Variable "confirm"; _ }; _ }; _ }, _) -> Task
  | Binary (Sequence, { it = Closure _; _ }, _) | Index ({ it = Closure _; _ }, _) -> Task
  | Index (a, _) when kind_of a = Task -> Task
  | Call { callee = { it = Variable "idle"; _ }; arguments = [ Positional e ] } -> (
      match kind_of e with Number -> Task | Vehicles -> Vehicles | _ -> Any)
  | Call { callee = { it = Variable name; _ }; _ } -> (
      match Builtins.find name with Some builtin -> builtin.result | None -> Any)
  | Wildcard | Binary _ | Conditional _ | Elvis _ | Increment _ | Call _ | Member _ | Index _ | Pick_else _ | When _ ->
    Any

let kind_of e = kind_by (fun _ -> Builtins.Any) e

let could_be (wanted : Builtins.kind) (found : Builtins.kind) =
  match wanted, found with
  | Any, _ | _, Any | Task, Closure -> true
  | (Number | String | Truth | Closure | Task | Vehicles | Position | Other), _ -> wanted = found

let is_hidden env name =
  Scope.find_local env.code name <> None || Scope.find_function env.program name <> None

(* A name that the program defines hides the built-in of that name from this check. *)
let known_kind env (e : Ast.expression) =
  match e.it with
  | Call { callee = { it = Variable name; _ }; _ }
    when is_hidden env name -> Builtins.Any
  | _ -> kind_of e

let operand_kind env (e : Ast.expression) =
  let variable name = if is_hidden env name then Builtins.Any else Scope.kind_of_variable env.program name in
  match e.it with
  | Call _ -> known_kind env e
  | _ -> kind_by variable e

let describe_other (e : Ast.expression) =
  match e.it with
  | Null -> "null"
  | List _ -> "a list"
  | Map _ -> "a map"
  | Range _ -> "a range"
  | _ -> "something else"

let check_found env what wanted found (e : Ast.expression) =
  let hint =
    match wanted, e.it with
    | Builtins.Task, Binary (And, _, _) -> Some "tasks one after the other are a >> b, tasks at once a | b"
    | Builtins.Task, Binary (Or, _, _) -> Some "tasks at once are a | b; oneOf { when { C } then a } takes one"
    | _, _ -> None
  in
  if not (could_be wanted found) then
    error env ?hint Wrong_kind e.at "%s takes %s, this is %s" what (Builtins.describe wanted)
      (match found with Builtins.Other -> describe_other e | found -> Builtins.describe found)

let check_kind env what wanted e = check_found env what wanted (known_kind env e) e
let check_operand env what wanted e = check_found env what wanted (operand_kind env e) e

let hint_for_operand env symbol (e : Ast.expression) =
  match e.it with
  | String name -> Some (Printf.sprintf "a plan is named by task('%s')" name)
  | Call { callee = { it = Variable ("running" | "connected" as name); _ }; _ } when not (is_hidden env name) ->
    Some (Format.asprintf "a task that waits for it is condition { %a }" Dolphin_syntax.Print.expression e)
  | Call { callee = { it = Variable name; _ }; _ } when Builtins.is_deed name && not (is_hidden env name) ->
    Some (Format.asprintf "a task does this as an action: action { %a }" Dolphin_syntax.Print.expression e)
  | Call { callee = { it = Variable name; _ }; _ } when Builtins.is_of_script name && not (is_hidden env name) ->
    Some (Printf.sprintf "%s belongs to the script: do it before execute" name)
  | During (on_cut, d, _) when e.at.start.pos_cnum < d.at.start.pos_cnum && not (List.mem symbol [ ">>"; "|"; "&" ]) ->
    let word = Dolphin_syntax.Print.during on_cut in
    Some (Format.asprintf "if it belongs to the time, put that in parentheses: %s (%a %s ...)" word
            Dolphin_syntax.Print.expression d symbol)
  | _ -> None

(* "50%" is meant as 50.percent, "3" as 3. *)
let hint_for_number text =
  let digits = String.concat "" (String.split_on_char '%' text) in
  match Dolphin_numerals.Numeral.number digits with
  | Some _ when digits <> text -> Some (Printf.sprintf "a share is a number: %s.percent" digits)
  | Some _ -> Some (Printf.sprintf "a number stands without quotes: %s" text)
  | None -> None

let describe_kind env e = Builtins.describe (operand_kind env e)

(* The first of [operands] that surely is of none of these kinds. *)
let check_operands env wanted operands ~complain =
  let is_wrong e = List.for_all (fun kind -> not (could_be kind (operand_kind env e))) wanted in
  Option.iter complain (List.find_opt is_wrong operands)

let check_operator env (op : Ast.binary) (a : Ast.expression) (b : Ast.expression) =
  let symbol = Dolphin_syntax.Print.operator op in
  let wrong (e : Ast.expression) ?hint format =
    let hint = match hint with Some _ -> hint | None -> hint_for_operand env symbol e in
    error env ?hint Wrong_kind e.at format in
  let compose (e : Ast.expression) = wrong e "%s composes tasks, and this is %s" symbol (describe_kind env e) in
  match op, operand_kind env a, operand_kind env b with
  | Sequence, _, _ -> List.iter (fun e -> check_operands env [ Task ] [ e ] ~complain:compose) [ a; b ]
  | Parallel, Task, _ -> check_operands env [ Task ] [ b ] ~complain:compose
  | Parallel, _, Task -> check_operands env [ Task ] [ a ] ~complain:compose
  | Parallel, _, _ ->
    let complain e =
      let expected = "two tasks, or a vehicle set and a predicate { v -> ... }" in
      wrong e "| takes %s, and this is %s" expected (describe_kind env e)
    in
    check_operands env [ Task; Vehicles ] [ a ] ~complain;
    check_operands env [ Task ] [ b ] ~complain
  | Intersect, _, _ ->
    let complain e =
      let hint = if operand_kind env e = Task then Some "tasks at once are a | b" else None in
      wrong e ?hint "& takes two vehicle sets or two areas, and this is %s" (describe_kind env e) in
    check_operands env [ Vehicles ] [ a; b ] ~complain
  | (Multiply | Divide | Remainder | Power | Add | Subtract), found, other
    when (found = Task || other = Task) && (op <> Add || (found <> String && other <> String)) ->
    let e = if operand_kind env a = Task then a else b in
    let hint =
      match op, b.it with
      | Divide, (During (_, _, { it = Closure _; _ }) | Until (_, _, { it = Closure _; _ })) ->
        Some "parentheses around the task and its condition: (T / { condition }) ..., or T until { condition } ..."
      | _, _ when found = other -> Some "tasks one after the other are a >> b, tasks at once a | b"
      | _, _ -> None
    in
    wrong e ?hint "%s takes no task" symbol
  | (Less | Less_equal | Greater | Greater_equal), found, other
    when not (List.exists (fun kind -> could_be kind found && could_be kind other) [ Builtins.Number; String ]) ->
    let e = if List.mem found [ Builtins.Number; String ] then b else a in
    let hint = match e.it, found with String text, Number -> hint_for_number text | _ -> None in
    error env ?hint Wrong_kind e.at "%s compares two numbers or two strings, and this is %s beside %s" symbol
      (describe_kind env e) (describe_kind env (if e == a then b else a))
  | (Subtract | Multiply | Divide | Remainder | Power), _, _ ->
    let wanted : Builtins.kind list = if op = Subtract then [ Number; Vehicles; Other ] else [ Number ] in
    let hint (e : Ast.expression) = match e.it with String text -> hint_for_number text | _ -> None in
    let takes = if op = Subtract then "numbers, lists, areas or vehicle sets" else "two numbers" in
    let complain (e : Ast.expression) =
      error env ?hint:(hint e) Wrong_kind e.at "%s takes %s, and this is %s" symbol takes (describe_kind env e) in
    check_operands env wanted [ a; b ] ~complain
  | _, _, _ -> ()

(* {1 Places of names} *)

let keys_of arguments =
  List.map (function Ast.Positional _ | Keyed _ -> None | Named (name, _) -> Some name.Ast.it) arguments

let value_of = function Ast.Positional e | Named (_, e) | Keyed (_, e) -> e

(* "Speed.Units.RPM" of the members that spell it. *)
let rec dotted (e : Ast.expression) =
  match e.it with
  | Variable name -> Some name
  | Member { subject; name; safe = false } ->
    Option.map (fun subject -> subject ^ "." ^ name.it) (dotted subject)
  | _ -> None

(* The beginning of an expression, and the expression around it. *)
let first_operand (e : Ast.expression) : (Ast.expression * (Ast.expression -> Ast.expression_node)) option =
  let begins (first : Ast.expression) = first.at.start.pos_cnum = e.at.start.pos_cnum in
  match e.it with
  | Binary (op, first, second) -> Some (first, fun first -> Binary (op, first, second))
  | Index (first, index) -> Some (first, fun first -> Index (first, index))
  | Member m -> Some (m.subject, fun subject -> Member { m with subject })
  | Call c -> Some (c.callee, fun callee -> Call { c with callee })
  | Range r -> Some (r.first, fun first -> Range { r with first })
  | Conditional (test, yes, no) -> Some (test, fun test -> Conditional (test, yes, no))
  | Elvis (first, otherwise) -> Some (first, fun first -> Elvis (first, otherwise))
  | During (e, d, t) when begins t -> Some (t, fun t -> During (e, d, t))
  | Until (e, c, t) when begins t -> Some (t, fun t -> Until (e, c, t))
  | Ensure (t, c) -> Some (t, fun t -> Ensure (t, c))
  | _ -> None

let rec regrouped ~is_procedure (e : Ast.expression) : Ast.expression option =
  match e.it with
  | Call { callee = { it = Variable name; _ }; arguments = [ Positional _ ] } ->
    if is_procedure name then Some e else None
  | _ ->
    let around (first, rebuild) =
      match regrouped ~is_procedure first with
      | Some ({ it = Call { callee; arguments = [ Positional argument ] }; _ } as whole) ->
        let at = { e.at with start = argument.at.start } in
        let argument = Ast.Positional { Ast.it = rebuild argument; at } in
        Some { Ast.it = Ast.Call { callee; arguments = [ argument ] }; at = { whole.at with stop = e.at.stop } }
      | Some _ | None -> None
    in
    Option.bind (first_operand e) around

let root name = match String.index_opt name '.' with Some i -> String.sub name 0 i | None -> name

let in_settings env name =
  match Scope.settings env.code with
  | Some (builder, slot) when List.mem name (Builtins.settings builder) -> Some slot
  | Some _ | None -> None

(* [lon -8.7] and [message -5] are subtractions. *)
let check_subtraction env (e : Ast.expression) =
  match e.it with
  | Binary (Subtract, { it = Variable name; _ }, second)
    when (not (is_hidden env name))
      && (in_settings env name <> None
          || (Builtins.find name <> None && not (Scope.is_assigned env.program name))) ->
    error env No_value e.at "'%s -' is read as a subtraction" name
      ~hint:(Format.asprintf "put parentheses around the value: %s(-%a)" name Dolphin_syntax.Print.expression second);
    false
  | _ -> true

let check_no_setting env (target : Ast.expression) (value : Ast.expression) =
  match target.it with
  | Member { subject = { it = Variable name; _ }; name = field; _ }
    when in_settings env name <> None && not (is_hidden env name) ->
    error env Misplaced_setting target.at "'%s.%s = ' assigns a variable and sets nothing" name field.it
      ~hint:(if name = "speed" then "write speed 900, Speed.Units.RPM"
             else Printf.sprintf "a setting is written with its values: %s VALUE" name)
  | Variable name when in_settings env name <> None && not (is_hidden env name) ->
    let example =
      match value.it with
      | String s -> Printf.sprintf "%s '%s'" name s
      | Integer n -> Printf.sprintf "%s %d" name n
      | _ -> Printf.sprintf "%s VALUE" name
    in
    error env Misplaced_setting target.at "'%s = ' assigns a variable and sets nothing" name
      ~hint:(Printf.sprintf "write %s" example)
  | _ -> ()

let check_parameters program (parameters : string Ast.located list) =
  let check seen (x : string Ast.located) =
    if List.mem x.it seen then
      Scope.report program
        (Diagnostic.error ~code:Defined_twice x.at (Printf.sprintf "two parameters are called '%s'" x.it));
    x.it :: seen
  in
  ignore (List.fold_left check [] parameters)

(* Whether this task surely is done without any wait. *)
let rec never_waits env (e : Ast.expression) =
  match e.it with
  | Call { callee = { it = Variable (("action" | "assert") as name); _ }; _ } -> not (is_hidden env name)
  | Binary ((Sequence | Parallel), a, b) -> never_waits env a && never_waits env b
  | Until (_, _, t) | During (_, _, t) | Watch (t, _) | Ensure (t, _) | Repeat { body = t; _ } -> never_waits env t
  | _ -> false

(* Parentheses belong to the location of the expression in them. *)
let rec before_condition (e : Ast.expression) =
  match e.it with
  | Binary ((And | Or | Equal | Not_equal | Less | Less_equal | Greater | Greater_equal | Member_of), first, _)
    when first.at.start.pos_cnum = e.at.start.pos_cnum -> Some (Option.value (before_condition first) ~default:first)
  | _ -> None

(* [consume go: 1 && x] is read as [consume(go: (1 && x))]. *)
let check_value env name (key : string Ast.located) (e : Ast.expression) =
  let warn (first : Ast.expression) =
    let hint =
      Format.asprintf "if the value ends earlier, write %s(%s: %a); if not, put parentheses around it" name key.it
        Dolphin_syntax.Print.expression first
    in
    Scope.report env.program
      (Diagnostic.warning Wide_value e.at (Printf.sprintf "all of this is the value of '%s'" key.it) ~hint)
  in
  Option.iter warn (before_condition e)

(* The settings that a [pick] has at most once. *)
let single_settings = [ "id"; "type"; "region"; "count"; "timeout" ]

let check_repeated env (builder : Ast.builder) (body : Ast.statement list) =
  let setting (s : Ast.statement) : string Ast.located option =
    match s.it with
    | Setting (name, _) -> Some name
    | Expression { it = Call { callee = { it = Variable name; at }; _ }; _ } -> Some { it = name; at }
    | _ -> None
  in
  let check seen (name : string Ast.located) =
    if List.mem name.it seen then
      error env Defined_twice name.at "'%s' stands twice" name.it ~hint:"the second one would replace the first";
    if List.mem name.it single_settings then name.it :: seen else seen
  in
  match builder with
  | Pick | Recruit -> ignore (List.fold_left check [] (List.filter_map setting body))
  | Imc_plan | Mission | Pos | All_of | One_of -> ()

(* Settings of a fence: {!Fence_declarations}. *)
let fence = "fence"

(* The declaration of the place of plans: {!Default_place}. *)
let locate = "locate"

let builder_name : Ast.builder -> string = function
  | Pick -> "pick"
  | Recruit -> "recruit"
  | Imc_plan -> "imcPlan"
  | Mission -> "mission"
  | Pos -> "pos"
  | All_of -> "allOf"
  | One_of -> "oneOf"

let builder_of_setting name =
  let has builder = List.mem name (Builtins.settings builder) in
  Option.map builder_name (List.find_opt has [ Ast.Pick; Pos; Imc_plan; Mission ])

let check_in_script env name at =
  if env.answer then error env Deed_in_answer at "%s may not stand in an answer" name;
  Scope.note_blocking env.code name;
  match Scope.in_task env.code with
  | Some construct ->
    error env Waits_in_task at "%s belongs to the script: the code of %s is part of a task and cannot wait" name
      construct
      ~hint:"do it before execute, or split the task"
  | None -> ()

let check_supplier env (subject : Ast.expression) member =
  match subject.it with
  | Variable name when Scope.is_supplier env.program name && not (is_hidden env name) ->
    check_in_script env (Printf.sprintf "%s.%s" name member.Ast.it) subject.at
  | _ -> ()

let check_in_maker env what at =
  if Scope.purpose env.code = Maker then
    error env Deed_in_maker at "%s may not stand here: code in the place of a task makes it, and may only compute" what
      ~hint:"a task does this as an action { ... }"

let check_place env (builtin : Builtins.t) name at =
  if Builtins.changes name then check_in_maker env name at;
  if builtin.reads_sensors then Scope.note_sensor env.program;
  (match builtin.arguments with
   | These { operation = Is_running; _ } -> Scope.note_running env.program
   | These { operation = Now; _ } -> Scope.note_now env.program
   | These { operation = Retry; _ } -> Scope.note_rounds env.program
   | _ -> ());
  match builtin.place with
  | Anywhere -> ()
  | Script_only -> check_in_script env name at
  | Handler_only -> (
      match Scope.purpose env.code with
      | Handler | Named_function _ | Plain -> ()
      | Main | Task_code _ | Maker -> error env Handler_only at "%s() belongs in onError { ... }" name)
  | In_handler ->
    if not (Scope.in_handler env.code) then
      error env Handler_only at "%s() stands in the text of onError { ... }, and nowhere else" name

let sensor_members =
  [ "position"; "battery"; "getPosition"; "getBattery"; "latitude"; "longitude"; "getType"; "type" ]
