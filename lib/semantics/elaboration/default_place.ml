module Ast = Dolphin_syntax.Ast
module Diagnostic = Dolphin_syntax.Diagnostic

let ( let* ) = Result.bind
let word = Checks.locate

(* {1 The declaration} *)

let declaration (s : Ast.statement) =
  let read (e : Ast.expression) =
    match (Option.value (Checks.regrouped ~is_procedure:(String.equal word) e) ~default:e).it with
    | Call { callee = { it = Variable name; at }; arguments } when name = word -> Some (at, arguments)
    | Variable name when name = word -> Some (e.at, [])
    | _ -> None
  in
  match s.it with Expression e -> read e | _ -> None

let is_declaration s = declaration s <> None

let error ?hint at format =
  Printf.ksprintf (fun m -> Error [ Diagnostic.error ?hint ~code:Wrong_value at m ]) format

let read constants at (arguments : Ast.argument list) =
  let wrong (d : Diagnostic.t) : Diagnostic.t = if d.code = Bad_fence then { d with code = Wrong_value } else d in
  let value : Ast.argument -> _ = function
    | Positional e -> Result.map_error (List.map wrong) (Constants.value constants e)
    | Named (k, _) -> error k.at "locate takes no arguments by name"
    | Keyed (e, _) -> error e.at "locate takes no arguments by name"
  in
  let* positional = Dolphin_results.Results.map value arguments in
  let setting : Core.setting = { setting = word; positional; named = []; setting_site = 0 } in
  match Plan_builder.located setting with
  | Ok place -> Ok place
  | Error fault -> error at "%s" fault.message ~hint:"as in locate 41.1852, -8.7048 or locate Location.APDL"

let is_own (ast : Ast.program) =
  Assigned.Names.mem word (Assigned.names ast) || List.mem word (Constants.function_names ast)

let of_program constants ast =
  match List.filter_map declaration ast with
  | [] -> Ok None
  | _ :: _ when is_own ast -> Ok None
  | [ (at, arguments) ] -> Result.map Option.some (read (Lazy.force constants) at arguments)
  | _ :: (at, _) :: _ -> error at "locate stands twice: a program has one place for its plans"

(* {1 Plans without a place} *)

let named (arguments : Ast.argument list) =
  let entry = function { Ast.it = Ast.Name k; _ }, e -> Some (k, e) | { Ast.it = Ast.Computed _; _ }, _ -> None in
  let of_argument : Ast.argument -> _ = function
    | Named (k, e) -> [ (k.it, e) ]
    | Positional { it = Map entries; _ } -> List.filter_map entry entries
    | Positional _ | Keyed _ -> []
  in
  List.concat_map of_argument arguments

(* Arguments of maneuvers that are not spelt out may hold a location. *)
let is_open : Ast.argument -> bool = function
  | Positional { it = Map entries; _ } ->
    List.exists (function { Ast.it = Ast.Computed _; _ }, _ -> true | { Ast.it = Ast.Name _; _ }, _ -> false) entries
  | Positional _ | Keyed _ -> true
  | Named _ -> false

let gives_place name arguments =
  name = word || List.mem_assoc "location" (named arguments)
  || (Plan_builder.is_maneuver name && List.exists is_open arguments)

let needs_place name arguments =
  match name, List.assoc_opt "currPos" (named arguments) with
  | "move", _ -> true
  | "popup", Some { Ast.it = Ast.Boolean false; _ } -> true
  | "popup", (Some _ | None) -> false
  | _, (Some _ | None) -> Plan_builder.is_maneuver name

(* The setting that a statement or an expression of a plan is. *)
let setting (e : Ast.expression) =
  match e.it with
  | Call { callee = { it = Variable name; _ }; arguments } -> Some (name, arguments, e.at)
  | Variable name -> Some (name, [], e.at)
  | _ -> None

let setting_of (s : Ast.statement) =
  match s.it with
  | Expression e -> setting e
  | Setting (name, e) -> Some (name.it, [ Ast.Positional e ], name.at)
  | _ -> None

(* Whether a plan has a place where it needs one first; code before that leaves it open. *)
let rec first_place (body : Ast.statement list) =
  match body with
  | [] -> `Placed
  | s :: rest -> (
      match setting_of s with
      | Some (name, arguments, _) when gives_place name arguments ->
        if List.exists is_open arguments && name <> word then `Open else `Placed
      | Some (name, arguments, at) when needs_place name arguments -> `Unplaced (name, at)
      | Some (name, _, _) when List.mem_assoc name Plan_builder.vocabulary -> first_place rest
      | Some _ | None -> `Open)

(* The first setting that needs a place, in code too, if nothing in the plan gives one. *)
let only_unplaced (body : Ast.statement list) =
  let settings = List.rev (List.fold_left (Fold.statement (fun found e ->
      match setting e with Some s -> s :: found | None -> found)) [] body) in
  if List.exists (fun (name, arguments, _) -> gives_place name arguments) settings then None
  else
    Option.map (fun (name, _, at) -> (name, at))
      (List.find_opt (fun (name, arguments, _) -> needs_place name arguments) settings)

let without_place at message = Diagnostic.error ~code:No_place at message ~hint:Plan_builder.hint_for_place

(* The message of a fault has the hint in it. *)
let of_fault (d : Diagnostic.t) =
  let hint = "; " ^ Plan_builder.hint_for_place in
  if not (String.ends_with ~suffix:hint d.message) then None
  else Some (without_place d.at (String.sub d.message 0 (String.length d.message - String.length hint)))

let missing constants ast =
  let add found (e : Ast.expression) = match e.it with Builder (Imc_plan, body) -> (e, body) :: found | _ -> found in
  let plans = List.rev (List.fold_left (Fold.statement add) [] ast) in
  let own = Assigned.Names.elements (Assigned.names ast) @ Constants.function_names ast in
  let decides name = name = word || name = "move" || Plan_builder.is_maneuver name in
  let is_own = List.exists decides own in
  let of_plan (e, body) =
    let unplaced (name, at) = without_place at (Plan_builder.no_place name) in
    let of_constants () = Option.bind (Constants.fault (Lazy.force constants) e) of_fault in
    match if is_own then `Open else first_place body with
    | `Placed -> None
    | `Unplaced found -> Some (unplaced found)
    | `Open -> (
        match if is_own then None else only_unplaced body with
        | Some found -> Some (unplaced found)
        | None -> of_constants ())
  in
  List.filter_map of_plan plans
