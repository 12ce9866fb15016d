open Core
module Ast = Dolphin_syntax.Ast

exception Unsettled of Fault.t

let reading quantity text = Reading { quantity; text }

let battery world (s : World.vehicle_state) =
  match World.battery world s with
  | Some share -> Number share
  | None -> reading Amount (Printf.sprintf "battery(%s)" s.id)

let position world (s : World.vehicle_state) =
  match World.position world s with
  | Some p -> Position p
  | None -> reading Place (Printf.sprintf "position(%s)" s.id)

let keep (program : program) store =
  let one store (i, x) =
    match x with
    | Reading r when r.text <> program.global_names.(i) ->
      Store.set i (Reading { r with text = program.global_names.(i) }) store
    | _ -> store
  in
  List.fold_left one store (Store.bindings store)

let is_reading = function Reading _ -> true | _ -> false

let unsettled at text =
  raise
    (Unsettled
       (Fault.make at
          (Printf.sprintf
             "what %s is, is open, and more than a comparison depends on it: the fleet can give the values it may have"
             text)))

let settled at = function Reading r -> unsettled at r.text | x -> x

(* Comparisons beyond these, of one step, are too many to list the outcomes of. *)
let most_claims = 12

let claim world at text =
  match World.claimed world text with
  | Some holds -> holds
  | None -> if World.claims world >= most_claims then unsettled at text else World.claim world text

let spell x = match x with Reading r -> r.text | x -> Format.asprintf "%a" Value.pp (Value.canonical x)

(* As an operand of another operation. *)
let enclosed text = if String.contains text ' ' then "(" ^ text ^ ")" else text

let spell_binary symbol x y = Printf.sprintf "%s %s %s" (enclosed (spell x)) symbol (enclosed (spell y))

let is_amount = function Reading { quantity = Amount; _ } -> true | x -> Value.to_number x <> None
let is_place = function Reading { quantity = Place; _ } | Position _ -> true | _ -> false
let is_region = function Reading { quantity = Region; _ } | Area _ -> true | _ -> false
let is_words = function Reading { quantity = Words; _ } | String _ -> true | _ -> false

let coordinates =
  [ "latitude"; "lat"; "longitude"; "lon"; "height"; "getLatitude"; "getLat"; "getLongitude"; "getLon"; "getHeight" ]

(* They make numbers of numbers, without fail; [round] and the like too, of all that a battery or a place gives. *)
let numeric = [ "abs"; "round"; "intValue"; "toInteger"; "doubleValue"; "toDouble" ]
let mathematical = [ "abs"; "round"; "floor"; "ceil"; "min"; "max" ]

let distances = [ "distance"; "distanceTo"; "bearing"; "bearingTo" ]

let binary world at (op : Ast.binary) x y =
  let truth claimed = Some (Ok (Boolean claimed)) in
  let holds symbol x y = claim world at (spell_binary symbol x y) in
  let computed quantity symbol = Some (Ok (reading quantity (spell_binary symbol x y))) in
  match op with
  | Less when is_amount x && is_amount y -> truth (holds "<" x y)
  | Greater_equal when is_amount x && is_amount y -> truth (not (holds "<" x y))
  | Greater when is_amount x && is_amount y -> truth (holds ">" x y)
  | Less_equal when is_amount x && is_amount y -> truth (not (holds ">" x y))
  | Equal -> truth (holds "==" x y)
  | Not_equal -> truth (not (holds "==" x y))
  | Member_of when is_place x && is_region y -> truth (holds "in" x y)
  | Add when is_words x || is_words y -> Some (Ok (reading Words (Value.to_string x ^ Value.to_string y)))
  | Add when is_amount x && is_amount y -> computed Amount "+"
  | Subtract when is_amount x && is_amount y -> computed Amount "-"
  | Multiply when is_amount x && is_amount y -> computed Amount "*"
  | Divide when is_amount x && Value.to_number y = Some 0. -> Some (Error "division by zero")
  | Divide when is_amount x && Value.to_number y <> None -> computed Amount "/"
  | Around when is_place x && (match Value.to_number y with Some r -> r >= 0. | None -> false) -> computed Region "^"
  | Less | Less_equal | Greater | Greater_equal | Member_of | Add | Subtract | Multiply | Divide | Around | Remainder
  | Power | Sequence | Append | Intersect | Parallel | And | Or -> None

let method_call world at name arguments =
  match arguments with
  | [ x ] when is_place x && List.mem name coordinates ->
    Some (Ok (reading Amount (Printf.sprintf "%s.%s" (spell x) name)))
  | [ x ] when is_amount x && List.mem name numeric ->
    Some (Ok (reading Amount (Printf.sprintf "%s.%s()" (enclosed (spell x)) name)))
  | [ x; Integer digits ] when is_amount x && name = "round" ->
    Some (Ok (reading Amount (Printf.sprintf "%s.round(%d)" (enclosed (spell x)) digits)))
  | [ x; y ] when is_place x && is_place y && List.mem name distances ->
    Some (Ok (reading Amount (Printf.sprintf "%s.%s(%s)" (spell x) name (spell y))))
  | [ x; y ] when name = "contains" -> binary world at Member_of y x
  | [ x; y ] when name = "equals" -> binary world at Equal x y
  | _ -> None

let apply world at operation arguments =
  let result =
    match operation, arguments with
    | Binary op, [ x; y ] -> binary world at op x y
    | Unary Negate, [ Reading { quantity = Amount; text } ] -> Some (Ok (reading Amount ("-" ^ enclosed text)))
    | Concatenate, parts -> Some (Ok (reading Words (String.concat "" (List.map Value.to_string parts))))
    | Builtin (Math name), xs when List.mem name mathematical && List.for_all is_amount xs ->
      Some (Ok (reading Amount (Printf.sprintf "Math.%s(%s)" name (String.concat ", " (List.map spell xs)))))
    | Property name, [ x ] when is_place x -> method_call world at name [ x ]
    | Method (name, names), arguments when List.for_all Option.is_none names -> method_call world at name arguments
    | _, _ -> None
  in
  match result, operation, arguments with
  | Some result, _, _ -> Some result
  | None, Call names, Closure _ :: _ when List.for_all Option.is_none names -> None
  | None, Builtin (Message | Halt | Assert | Is_host), _ -> None
  | None, _, _ ->
    let texts = List.filter_map (function Reading r -> Some r.text | _ -> None) arguments in
    unsettled at (String.concat ", " texts)
