open Core
open Checks
module Ast = Dolphin_syntax.Ast

(* {1 Members, and calls} *)

let example : Builtins.kind -> value option = function
  | Vehicles -> Some (Vehicles [ "v" ])
  | String -> Some (String "")
  | Position -> Some (Position Dolphin_geo.Place.apdl)
  | Number -> Some (Integer 0)
  | Task | Any | Truth | Closure | Other -> None

let hint_for_member (subject : Ast.expression) (name : string Ast.located) x =
  match subject.it, Builtins.find name.it, x with
  | Variable v, Some { arguments = These { required = [ Vehicles ]; _ }; _ }, Vehicles _ ->
    Some (Printf.sprintf "write %s(%s)" name.it v)
  | _, _, Vehicles _ when name.it = "name" -> Some "the name of a vehicle is its id"
  | _ -> Option.map (Printf.sprintf "did you mean '%s'?") (Methods.like x name.it)

(* A member that no value of the subject's kind has. With arguments only misspellings are sure. *)
let member env ~called ?(arguments = []) (subject : Ast.expression) (name : string Ast.located) =
  match example (operand_kind env subject) with
  | Some (Integer _) when not called -> ()  (* a unit *)
  | Some x when not (Methods.may_have x name.it) && (arguments = [] || Methods.like x name.it <> None) ->
    error env Unknown_name name.at "%s has no %s '%s'" (Builtins.describe (operand_kind env subject))
      (if called then "method" else "property") name.it ?hint:(hint_for_member subject name x)
  | Some _ | None -> ()

(* A call without parentheses, [f a]: it ends with its last argument. *)
let is_bare (call : Ast.expression) =
  match call.it with
  | Call { arguments; _ } -> (
      match List.rev arguments with
      | (Positional last | Named (_, last) | Keyed (_, last)) :: _ -> last.at.stop.pos_cnum = call.at.stop.pos_cnum
      | [] -> false)
  | _ -> false

(* Calls of values that surely are not functions. *)
let callee env (callee : Ast.expression) arguments =
  match operand_kind env callee, callee.it with
  | ((Number | String | Vehicles | Position | Task | Truth) as kind), _ ->
    let hint =
      match callee.it with
      | Variable x when (match arguments with [ Ast.Positional e ] -> is_bare e | _ -> false) ->
        Some (Printf.sprintf "a ';' or a new line is missing behind '%s'" x)
      | Integer n -> Some (Printf.sprintf "for rounds of a task, write repeat %d, T" n)
      | _ when kind = Vehicles -> Some "one of them is vs[0]; a task on them is T[vs]"
      | _ -> None
    in
    error env ?hint Wrong_kind callee.at "this is %s, not a function to call" (Builtins.describe kind)
  | (Any | Closure | Other), _ -> ()

(* {1 The prelude} *)

(* The kind of a parameter of the prelude, by its name there. *)
let kind_of_parameter : string -> Builtins.kind = function
  | "k" | "n" | "period" | "d" | "least" | "most" -> Number
  | "T" -> Task
  | "tasks" | "goals" -> Other
  | "name" -> String
  | _ -> Any

let parameters_of (entry : Dolphin_syntax.Prelude.entry) =
  match String.split_on_char '(' entry.form with
  | _ :: inside :: _ ->
    let names = List.hd (String.split_on_char ')' inside) in
    let with_code = String.contains entry.form '{' in
    (List.map (fun name -> kind_of_parameter (String.trim name)) (String.split_on_char ',' names)
     @ if with_code then [ Builtins.Closure ] else [])
  | _ -> []

let describe_wanted : Builtins.kind -> string = function
  | Other -> "a list"
  | (Any | Number | String | Truth | Closure | Task | Vehicles | Position) as kind -> Builtins.describe kind

let prelude_call env (entry : Dolphin_syntax.Prelude.entry) arguments =
  let check (wanted : Builtins.kind) (e : Ast.expression) =
    let found = operand_kind env e in
    if not (could_be wanted found || (wanted = Other && found = Vehicles)) then
      error env Wrong_kind e.at "%s takes %s here, this is %s" entry.name (describe_wanted wanted)
        (if found = Other then "a list or another value" else Builtins.describe found)
        ~hint:("write " ^ entry.form)
  in
  let wanted = parameters_of entry in
  if List.compare_lengths wanted arguments = 0 then List.iter2 check wanted (List.map value_of arguments)
