open Dolphin_semantics
open Core

(* An expression, with the code whose locals it has. *)
type placed = { within : lambda; e : expression }

type text = {
  program : program;
  globals : (int, placed) Hashtbl.t;  (* the expressions assigned to each *)
  locals : (int * int, placed option) Hashtbl.t;  (* the same, by code and slot; [None]: by a loop *)
  calls : (int, lambda * string option list * expression list) Hashtbl.t;  (* of functions by their names *)
  mentions : (int, unit) Hashtbl.t;  (* of functions, in calls and elsewhere *)
}

let text program =
  let t =
    { program; globals = Hashtbl.create 16; locals = Hashtbl.create 16; calls = Hashtbl.create 16;
      mentions = Hashtbl.create 16 } in
  let note within e =
    List.iter (fun (i, e) -> Hashtbl.add t.globals i { within; e }) (Code_walk.assigned e);
    match e.node with
    | Set_local (slot, e) -> Hashtbl.add t.locals (within.id, slot) (Some { within; e })
    | For (slot, _, _) -> Hashtbl.add t.locals (within.id, slot) None
    | Apply (Call names, { node = Constant (Closure { lambda; _ }); _ } :: arguments) ->
      Hashtbl.add t.calls lambda.id (within, names, arguments)
    | Constant (Closure { lambda; _ }) -> Hashtbl.add t.mentions lambda.id ()
    | _ -> ()
  in
  Code_walk.iter_within note (Code_walk.pieces program);
  t

(* The possible values of the parameter in [slot], if all calls of [lambda] are visible: it is a function, and used
   only in calls. *)
let given t lambda slot =
  let calls = Hashtbl.find_all t.calls lambda.id in
  let is_function = List.exists (fun (_, l) -> l == lambda) t.program.functions in
  let argument (within, names, arguments) =
    if List.for_all Option.is_none names && List.compare_length_with arguments lambda.parameters = 0 then
      Some { within; e = List.nth arguments slot }
    else None
  in
  if is_function && List.compare_lengths calls (Hashtbl.find_all t.mentions lambda.id) = 0 then List.map argument calls
  else [ None ]

let in_local t lambda slot =
  if Array.exists (( = ) slot) lambda.captures then [ None ]
  else
    (if slot < lambda.parameters then given t lambda slot else []) @ Hashtbl.find_all t.locals (lambda.id, slot)

let is_literal e = match e.node with Constant (Integer _ | Number _) -> true | _ -> false

let is_number program =
  let t = text program in
  fun within e ->
    (* Variables already visited, or queued: one computed from numeric ones alone is numeric. *)
    let seen = Hashtbl.create 8 in
    let is_new x = not (Hashtbl.mem seen x) && (Hashtbl.add seen x (); true) in
    let rec go within e =
      let all = List.for_all (go within) in
      is_literal e
      ||
      match e.node with
      | Apply ((Unary Negate | Binary (Multiply | Remainder | Power) | Builtin (Math _)), _) -> true
      | Apply (Binary Subtract, es) -> List.exists is_literal es || all es
      | Apply (Binary (Add | Divide), es) -> all es
      | Apply (Property _, [ e ]) -> go within e
      | Global i -> (not (is_new (`Global i))) || List.for_all placed (Hashtbl.find_all t.globals i)
      | Local slot -> (not (is_new (`Local (within.id, slot)))) || List.for_all known (in_local t within slot)
      | If (_, a, b) -> all [ a; b ]
      | _ -> false
    and placed { within; e } = go within e
    and known x = Option.fold ~none:false ~some:placed x in
    go within e
