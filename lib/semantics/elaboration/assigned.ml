open Dolphin_syntax.Ast
module String_map = Map.Make (String)

(* Whether each name is assigned once only, to an expression that is [wanted]. Without [changes], [x += 1] and the like
   do not count. *)
let rec assignments ~changes wanted acc (s : statement) =
  let assignments = assignments ~changes in
  let note name once = String_map.update name (function None -> Some once | Some _ -> Some false) acc in
  match s.it with
  | Assign { operator = Some _; _ } when not changes -> acc
  | Assign { target = { it = Variable name; _ }; value; operator } -> note name (operator = None && wanted value)
  | Parameter { name; value; _ } -> note name.it (wanted value)
  | Define (name, Some e) -> note name.it (wanted e)
  | Define (name, None) | For (name, _, []) -> note name.it false
  | For (name, _, body) -> List.fold_left (assignments wanted) (note name.it false) body
  | If (_, yes, no) -> List.fold_left (assignments wanted) acc (yes @ no)
  | While (_, body) | Block body -> List.fold_left (assignments wanted) acc body
  | Function { parameters; body; _ } ->
    let acc =
      List.fold_left (fun acc (x : string located) -> String_map.add x.it false acc) acc parameters
    in
    List.fold_left (assignments wanted) acc body
  | Assign _ | Expression _ | Setting _ | Return _ | Break | Continue -> acc

(* Code inside of expressions assigns too, and its parameters hide variables of the same name. *)
let assignments_inside ~changes wanted acc (e : expression) =
  let assignments = assignments ~changes in
  let hide acc (x : string located) = String_map.add x.it false acc in
  match e.it with
  | Closure c | When (c, _) | Wait_for (c, _) | Until (_, c, _) | Watch (_, c)
  | Repeat { until = Some c; _ } ->
    let acc = List.fold_left (assignments wanted) acc c.body in
    List.fold_left hide acc (Option.value c.parameters ~default:[])
  | Recruit (settings, c) ->
    let acc = List.fold_left (assignments wanted) acc (settings @ c.body) in
    List.fold_left hide acc (Option.value c.parameters ~default:[])
  | Builder (_, body) -> List.fold_left (assignments wanted) acc body
  | Pick_else (settings, otherwise) -> List.fold_left (assignments wanted) acc (settings @ otherwise)
  | Increment { target = { it = Variable name; _ }; _ } when changes -> String_map.add name false acc
  | _ -> acc

let all ~changes wanted ast =
  let outside = List.fold_left (assignments ~changes wanted) String_map.empty ast in
  List.fold_left (Fold.statement (assignments_inside ~changes wanted)) outside ast

let names_of ~changes ast = List.map fst (String_map.bindings (all ~changes (fun _ -> false) ast))
let names ast = names_of ~changes:true ast
let given ast = names_of ~changes:false ast

let once wanted ast =
  List.filter_map (fun (x, once) -> if once then Some x else None) (String_map.bindings (all ~changes:true wanted ast))
