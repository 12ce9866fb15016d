open Dolphin_syntax.Ast
module Diagnostic = Dolphin_syntax.Diagnostic

(* {1 Single vehicles} *)

let picks_one body =
  List.for_all
    (fun (s : statement) ->
       match s.it with
       | Expression { it = Call { callee = { it = Variable "count"; _ }; arguments }; _ } -> (
           match arguments with [ Positional { it = Integer 1; _ } ] -> true | _ -> false)
       | Setting ({ it = "count"; _ }, e) -> e.it = Integer 1
       | Expression _ | Setting _ -> true
       | Assign _ | Define _ | Parameter _ | Function _ | If _ | While _ | For _ | Return _ | Break | Continue
       | Block _ -> false)
    body

(* {1 Tasks} *)

(* At least this number of vehicles at once. [execute (a | b)[v]] is read as an [execute] and an index: the text
   after the parentheses is part of its argument. *)
let rec width (e : expression) =
  match e.it with
  | Builder ((Imc_plan | Mission), _) | Call { callee = { it = Variable ("task" | "imcPlan"); _ }; _ } -> 1
  | Call { callee = { it = Variable "execute"; _ }; arguments = [ Positional a ] } -> width a
  | Binary (Parallel, a, b) -> width a + width b
  | Binary (Sequence, a, b) -> max (width a) (width b)
  | Binary (Divide, a, _) | Index (a, _) | Until (_, _, a) | During (_, _, a) | Watch (a, _) | Wait_for (_, a)
  | Repeat { body = a; _ } -> width a
  | _ -> 0

(* The single vehicles that a task surely runs on, each with its place in the text. *)
let rec surely singles (e : expression) =
  match e.it with
  | Index (a, { it = Variable v; at }) when List.mem v singles && width a > 0 -> [ (v, at) ]
  | Index (a, _) | Binary (Divide, a, _) | Until (_, _, a) | During (_, _, a) | Watch (a, _) | Wait_for (_, a)
  | Repeat { body = a; _ } -> surely singles a
  | Binary ((Sequence | Parallel), a, b) -> surely singles a @ surely singles b
  | Call { callee = { it = Variable "execute"; _ }; arguments = [ Positional a ] } -> surely singles a
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
    | Named (k, e) :: rest when List.mem k.it singles && width e > 0 ->
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
  | Index (a, { it = Variable v; at }) when List.mem v singles && width a > 1 ->
    too_narrow at v (width a) :: acc
  | Call { callee = { it = Variable "execute"; _ }; arguments } ->
    let narrow = function
      | Named (k, e) when List.mem k.it singles && width e > 1 -> Some (too_narrow k.at k.it (width e))
      | Named _ | Positional _ | Keyed _ -> None
    in
    List.filter_map narrow arguments @ named_clashes singles arguments @ acc
  | _ -> acc

let program ast =
  let picks_one (e : expression) = match e.it with Builder (Pick, body) -> picks_one body | _ -> false in
  match Assigned.once picks_one ast with
  | [] -> []
  | singles -> List.fold_left (Fold.statement (at_expression singles)) [] ast
