open Dolphin_syntax.Ast
module Diagnostic = Dolphin_syntax.Diagnostic

(* Methods that only compute. Those that take code may do anything in it. *)
let computing =
  [ "abs"; "bearing"; "bearingTo"; "capitalize"; "contains"; "containsKey"; "containsValue"; "displace"; "distance";
    "distanceTo"; "drop"; "duration"; "endsWith"; "energy"; "equals"; "equalsIgnoreCase"; "first"; "get";
    "getBattery"; "getId"; "getPosition"; "getType"; "head"; "indexOf"; "isEmpty"; "isNumber"; "join"; "keySet";
    "keys"; "last"; "length"; "max"; "min"; "padLeft"; "padRight"; "replace"; "rest"; "reverse"; "round"; "size";
    "sort"; "split"; "startsWith"; "substring"; "sum"; "tail"; "take"; "toDouble"; "toInteger"; "toList";
    "toLowerCase"; "toString"; "toUpperCase"; "trim"; "unique"; "values" ]

let procedures =
  [ "task"; "imcPlan"; "action"; "condition"; "fresh"; "idle"; "location"; "area"; "position"; "battery"; "speed";
    "connected"; "reading"; "running"; "now"; "timeOfDay"; "eta"; "poll"; "progress"; "isNumber";
    "isString"; "isList"; "isMap" ]

(* Expressions that surely only compute. [is_own x] is whether the program itself defines [x]; [has_host], whether
   there may be objects of the supplier, whose members may do anything. *)
type program = { is_own : string -> bool; has_host : bool }

let rec computes p (e : expression) =
  let all es = List.for_all (computes p) es in
  let argument = function
    | Positional { it = Closure _; _ } -> false
    | Positional e | Named (_, e) -> computes p e
    | Keyed (k, e) -> computes p k && computes p e
  in
  match e.it with
  | Null | Boolean _ | Integer _ | Number _ | String _ | Wildcard | Closure _ -> true
  | Variable x -> p.is_own x || Builtins.find x = None
  | Template parts -> List.for_all (function Literal _ -> true | Hole e -> computes p e) parts
  | List es -> all es
  | Map entries -> List.for_all (fun (_, e) -> computes p e) entries
  | Binary (Append, _, _) -> false
  | Binary (Divide, a, { it = Closure _; _ }) -> computes p a
  | Binary (_, a, b) | Range { first = a; last = b; _ } | Elvis (a, b) | Index (a, b) | During (_, a, b) -> all [ a; b ]
  | Unary (_, e) -> computes p e
  | Conditional (a, b, c) -> all [ a; b; c ]
  | Member { subject; _ } -> (not p.has_host) && computes p subject
  | Call { callee = { it = Variable name; _ }; arguments } when List.mem name procedures ->
    let code = function Positional { it = Closure _; _ } -> true | a -> argument a in
    (not (p.is_own name)) && List.for_all code arguments
  | Call { callee = { it = Member { subject = { it = Variable "Math"; _ }; _ }; _ }; arguments } ->
    (not (p.is_own "Math")) && List.for_all argument arguments
  | Call { callee = { it = Member { subject; name; _ }; _ }; arguments } ->
    (not p.has_host) && List.mem name.it computing && computes p subject && List.for_all argument arguments
  | Wait_for (_, t) | Until (_, _, t) | Watch (t, _) | Ensure (t, _) -> computes p t
  | Repeat { rounds; body; _ } -> all (body :: Option.to_list rounds)
  | Increment _ | Call _ | Builder _ | Pick_else _ | Recruit _ | When _ -> false

let hint (e : expression) =
  match e.it with
  | Binary (Equal, { it = Variable x; _ }, _) -> Some (Printf.sprintf "an assignment is %s = ..." x)
  | Call { callee = { it = Member { subject = { it = Variable x; _ }; name; _ }; _ }; _ }
    when List.mem name.it [ "sort"; "reverse"; "unique"; "take"; "drop"; "tail"; "trim"; "replace" ] ->
    Some (Printf.sprintf "values never change: write %s = %s.%s(...)" x x name.it)
  | Binary ((Sequence | Parallel), _, _) | Until _ | During _ | Watch _ | Ensure _ | Wait_for _ | Repeat _
  | Recruit _ ->
    Some "execute runs a task"
  | _ -> None

(* Whether [Translate] reports it, as a task that is not executed. *)
let is_task ~top e = top && Checks.kind_of e = Builtins.Task

(* [def f(v) { { T } }]: whether the braces look like code that makes a task. *)
let looks_like_code body =
  match body with
  | [ { it = Expression e; _ } ] -> Checks.kind_of e = Builtins.Task
  | _ -> false

(* [value] is whether the last statement is the value of the code around. *)
let rec body p ~top ~value acc = function
  | [] -> acc
  | [ last ] -> statement p ~top ~value acc last
  | first :: rest -> body p ~top ~value (statement p ~top ~value:false acc first) rest

and statement p ~top ~value acc (s : statement) =
  let within = body p ~top:false in
  match s.it with
  | Expression e when (not value) && computes p e && not (is_task ~top e) ->
    Diagnostic.warning ?hint:(hint e) No_effect e.at "this has no effect: its value is not used" :: acc
  | If (_, yes, no) -> within ~value (within ~value acc yes) no
  | While (_, b) | For (_, _, b) -> within ~value:false acc b
  | Block b when value && looks_like_code b ->
    Diagnostic.warning No_effect s.at "these braces have no effect: the task in them is made at once"
      ~hint:"code that makes it at its turn is return { ... }; if that is not meant, leave them out"
    :: within ~value acc b
  | Block b -> within ~value acc b
  | Function { body = b; _ } -> within ~value:true acc b
  | Expression _ | Assign _ | Define _ | Parameter _ | Return _ | Break | Continue | Setting _ -> acc

(* The code inside of expressions. *)
let inside p acc (e : expression) =
  let code acc (c : closure) = body p ~top:false ~value:true acc c.body in
  match e.it with
  | Closure c | Recruit (_, c) | When (c, _) | Wait_for (c, _) | Until (_, c, _) | Watch (_, c) | Ensure (_, c)
  | Repeat { until = Some c; _ } -> code acc c
  | _ -> acc

let program (ast : Dolphin_syntax.Ast.program) =
  let own = Assigned.names ast in
  let calls_host has (e : expression) = has || match e.it with Variable "getSupplier" -> true | _ -> false in
  let p =
    {
      is_own = (fun x -> Assigned.Names.mem x own);
      has_host = List.fold_left (Fold.statement calls_host) false ast;
    }
  in
  List.fold_left (Fold.statement (inside p)) (body p ~top:true ~value:false [] ast) ast
