open Dolphin_syntax.Ast
module Diagnostic = Dolphin_syntax.Diagnostic
module String_map = Map.Make (String)

(* {1 Traversal} *)

let rec of_statement f acc (s : statement) =
  match s.it with
  | Expression e | Setting (_, e) | Return (Some e) | Define (_, Some e) -> of_expression f acc e
  | Assign { target; value; _ } -> of_expression f (of_expression f acc target) value
  | Function { body; _ } | Block body -> List.fold_left (of_statement f) acc body
  | If (e, yes, no) -> List.fold_left (of_statement f) (of_expression f acc e) (yes @ no)
  | While (e, body) | For (_, e, body) -> List.fold_left (of_statement f) (of_expression f acc e) body
  | Return None | Define (_, None) | Break | Continue -> acc

and of_expression f acc (e : expression) =
  let acc = f acc e in
  let go = of_expression f and body = List.fold_left (of_statement f) in
  match e.it with
  | Null | Boolean _ | Integer _ | Number _ | String _ | Variable _ | Wildcard -> acc
  | Template parts -> List.fold_left (fun acc -> function Literal _ -> acc | Hole e -> go acc e) acc parts
  | List es -> List.fold_left go acc es
  | Map entries -> List.fold_left (fun acc (_, e) -> go acc e) acc entries
  | Range { first = a; last = b; _ } | Binary (_, a, b) | Elvis (a, b) | Index (a, b) | During (a, b) -> go (go acc a) b
  | Closure c -> body acc c.body
  | Unary (_, e) | Increment { target = e; _ } | Member { subject = e; _ } -> go acc e
  | Conditional (a, b, c) -> go (go (go acc a) b) c
  | Call { callee; arguments } ->
    List.fold_left (fun acc -> function Positional e | Named (_, e) -> go acc e) (go acc callee) arguments
  | Builder (_, statements) -> body acc statements
  | When (c, e) | Wait_for (c, e) | Until (c, e) -> go (body acc c.body) e
  | Watch (e, c) -> body (go acc e) c.body

(* {1 Single vehicles} *)

let picks_one body =
  List.for_all
    (fun (s : statement) ->
       match s.it with
       | Expression { it = Call { callee = { it = Variable "count"; _ }; arguments }; _ } -> (
           match arguments with [ Positional { it = Integer 1; _ } ] -> true | _ -> false)
       | Setting ({ it = "count"; _ }, e) -> e.it = Integer 1
       | Expression _ | Setting _ -> true
       | Assign _ | Define _ | Function _ | If _ | While _ | For _ | Return _ | Break | Continue | Block _ -> false)
    body

(* How often each name is assigned, and whether to a pick of one vehicle. *)
let rec assignments acc (s : statement) =
  let note name single = String_map.update name (function None -> Some single | Some _ -> Some false) acc in
  let single (e : expression) = match e.it with Builder (Pick, body) -> picks_one body | _ -> false in
  match s.it with
  | Assign { target = { it = Variable name; _ }; value; operator } -> note name (operator = None && single value)
  | Define (name, Some e) -> note name.it (single e)
  | Define (name, None) | For (name, _, []) -> note name.it false
  | For (name, _, body) -> List.fold_left assignments (note name.it false) body
  | If (_, yes, no) -> List.fold_left assignments acc (yes @ no)
  | While (_, body) | Block body -> List.fold_left assignments acc body
  | Function { parameters; body; _ } ->
    let acc =
      List.fold_left (fun acc (x : string located) -> String_map.add x.it false acc) acc parameters
    in
    List.fold_left assignments acc body
  | Assign _ | Expression _ | Setting _ | Return _ | Break | Continue -> acc

(* Code inside of expressions assigns too, and its parameters hide variables of the same name. *)
let assignments_inside acc (e : expression) =
  let hide acc (x : string located) = String_map.add x.it false acc in
  match e.it with
  | Closure c | When (c, _) | Wait_for (c, _) | Until (c, _) | Watch (_, c) ->
    let acc = List.fold_left assignments acc c.body in
    List.fold_left hide acc (Option.value c.parameters ~default:[])
  | Builder (_, body) -> List.fold_left assignments acc body
  | Increment { target = { it = Variable name; _ }; _ } -> String_map.add name false acc
  | _ -> acc

(* {1 Tasks} *)

(* At least so many vehicles at once. *)
let rec width (e : expression) =
  match e.it with
  | Builder (Imc_plan, _) | Call { callee = { it = Variable ("task" | "imcPlan"); _ }; _ } -> 1
  | Binary (Parallel, a, b) -> width a + width b
  | Binary (Sequence, a, b) -> max (width a) (width b)
  | Binary (Divide, a, _) | Index (a, _) | Until (_, a) | During (_, a) | Watch (a, _) | Wait_for (_, a) -> width a
  | _ -> 0

(* The single vehicles that a task surely runs on, each with the place that says so. *)
let rec surely singles (e : expression) =
  match e.it with
  | Index (a, { it = Variable v; at }) when String_map.mem v singles && width a > 0 -> [ (v, at) ]
  | Index (a, _) | Binary (Divide, a, _) | Until (_, a) | During (_, a) | Watch (a, _) | Wait_for (_, a) ->
    surely singles a
  | Binary ((Sequence | Parallel), a, b) -> surely singles a @ surely singles b
  | _ -> []

let twice at v =
  Diagnostic.error ~code:Vehicle_twice at
    (Printf.sprintf "vehicle '%s' is given to two tasks that run side by side" v)
    ~hint:"tasks of one vehicle follow each other by >>"

let clashes singles branches =
  let rec from seen = function
    | [] -> []
    | branch :: rest ->
      let here = surely singles branch in
      let clash = List.filter (fun (v, _) -> List.mem_assoc v seen) here in
      List.map (fun (v, at) -> twice at v) clash @ from (here @ seen) rest
  in
  from [] branches

let named_clashes singles arguments =
  let rec from seen = function
    | Named (k, e) :: rest when String_map.mem k.it singles && width e > 0 ->
      let here = if List.mem k.it seen then [ twice k.at k.it ] else [] in
      here @ from (k.it :: seen) rest
    | _ :: rest -> from seen rest
    | [] -> []
  in
  from [] arguments

let too_narrow at v n =
  Diagnostic.error ~code:Vehicle_twice at
    (Printf.sprintf "'%s' is one vehicle, and the task needs %d at the same time" v n)
    ~hint:"tasks of one vehicle follow each other by >>"

let at_expression singles acc (e : expression) =
  match e.it with
  | Binary (Parallel, a, b) -> clashes singles [ a; b ] @ acc
  | Index (a, { it = Variable v; at }) when String_map.mem v singles && width a > 1 ->
    too_narrow at v (width a) :: acc
  | Call { callee = { it = Variable "execute"; _ }; arguments } ->
    let narrow = function
      | Named (k, e) when String_map.mem k.it singles && width e > 1 -> Some (too_narrow k.at k.it (width e))
      | Named _ | Positional _ -> None
    in
    List.filter_map narrow arguments @ named_clashes singles arguments @ acc
  | _ -> acc

let program ast =
  let assigned = List.fold_left assignments String_map.empty ast in
  let assigned = List.fold_left (of_statement assignments_inside) assigned ast in
  let singles = String_map.filter (fun _ single -> single) assigned in
  if String_map.is_empty singles then [] else List.fold_left (of_statement (at_expression singles)) [] ast
