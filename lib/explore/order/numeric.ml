open Dolphin_semantics
open Core

let assigned program =
  let all = Hashtbl.create 16 in
  let note e = match e.node with Set_global (i, e) -> Hashtbl.add all i e | _ -> () in
  Code_walk.iter note (Code_walk.pieces program);
  Hashtbl.find_all all

let is_literal e = match e.node with Constant (Integer _ | Number _) -> true | _ -> false

let is_number program =
  let assigned = assigned program in
  fun e ->
    (* Variables that are looked at already, or will be: what is computed from numbers alone is one. *)
    let seen = Hashtbl.create 8 in
    let is_new i = not (Hashtbl.mem seen i) && (Hashtbl.add seen i (); true) in
    let rec go e =
      is_literal e
      ||
      match e.node with
      | Apply ((Unary Negate | Binary (Multiply | Remainder | Power) | Builtin (Math _)), _) -> true
      | Apply (Binary Subtract, es) -> List.exists is_literal es || List.for_all go es
      | Apply (Binary (Add | Divide), es) -> List.for_all go es
      | Apply (Property _, [ e ]) -> go e
      | Global i -> (not (is_new i)) || List.for_all go (assigned i)
      | If (_, a, b) -> go a && go b
      | _ -> false
    in
    go e
