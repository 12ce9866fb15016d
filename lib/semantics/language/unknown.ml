open Core
open Code
module Ast = Dolphin_syntax.Ast

type applied = Gives of value | Needs of unknown | As_any

let is = function Unknown _ -> true | _ -> false
let first arguments = List.find_map (function Unknown u -> Some u | _ -> None) arguments

let binary (op : Ast.binary) u x y =
  match op with
  | Equal when x = Null || y = Null -> Gives (Boolean false)
  | Not_equal when x = Null || y = Null -> Gives (Boolean true)
  | Or -> Gives (if Value.truth x || Value.truth y then Boolean true else Unknown u)
  | And | Equal | Not_equal | Less | Less_equal | Greater | Greater_equal | Member_of | Subtract | Multiply | Divide
  | Remainder | Power | Around -> Gives (Unknown u)
  | Add -> (
      match x, y with
      | String _, _ | _, String _ | List _, _ -> As_any
      | _, _ -> Gives (Unknown u))
  | Append -> As_any
  | Sequence | Intersect | Parallel -> Needs u

let apply operation arguments =
  match first arguments with
  | None -> As_any
  | Some u -> (
      match operation, arguments with
      | Binary op, [ x; y ] -> binary op u x y
      | (Unary _ | Builtin (Math _)), _ -> Gives (Unknown u)
      | (Property _ | Method _), Unknown u :: _ -> Gives (Unknown u)
      | Method (("add" | "push" | "leftShift" | "put" | "contains" | "indexOf" | "equals"), _), _ -> As_any
      | (Call _ | Method ("call", _)), (Closure _ :: _) -> As_any
      | (Make_list | Make_map _ | Replace_element | Replace_member _ | Concatenate), _ -> As_any
      | Builtin (Message | Halt | Assert | Fail | Is_a _ | Is_host | Is_there), _ -> As_any
      | ( ( Binary _ | Make_range _ | Element | Property _ | Call _ | Method _ | Builtin _ | Add_setting _ | Build _
          | Pick_if_any | Make_branch | Make_recruit ),
          _ ) -> Needs u)

let iterated iteration results =
  match iteration, first results with
  | _, None | (Each | Collect | Inject), Some _ -> Ok None
  | (Any | Every | Sum), Some u -> Ok (Some (Unknown u))
  | (Find_all | Find | Count | Sort | Greatest | Least), Some u -> Error u
