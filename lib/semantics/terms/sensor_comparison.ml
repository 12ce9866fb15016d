(* The semantics spells a comparison in one way: two operands with [<], [>], [==] or [in] between them. *)

type t = string * bool
type bound = { value : float; closed : bool }
type range = { least : bound; most : bound }

let split_at symbol text =
  let n = String.length symbol and length = String.length text in
  let rec find depth i =
    if i + n > length then None
    else if depth = 0 && String.sub text i n = symbol then
      Some (String.sub text 0 i, String.sub text (i + n) (length - i - n))
    else
      match text.[i] with
      | '(' -> find (depth + 1) (i + 1)
      | ')' -> find (depth - 1) (i + 1)
      | _ -> find depth (i + 1)
  in
  find 0 0

let from value closed = { least = { value; closed }; most = { value = infinity; closed = false } }
let upto value closed = { least = { value = neg_infinity; closed = false }; most = { value; closed } }

(* The values of an operand for which the comparison of it with [x] has this outcome, if they are in a row. *)
let range symbol x holds =
  match symbol, holds with
  | "<", true -> Some (upto x false)
  | "<", false -> Some (from x true)
  | ">", true -> Some (from x false)
  | ">", false -> Some (upto x true)
  | "==", true -> Some { least = { value = x; closed = true }; most = { value = x; closed = true } }
  | _, _ -> None

let mirrored = function "<" -> ">" | ">" -> "<" | symbol -> symbol

(* The operand that a claim compares with a number, and the values that it may have. *)
let ranged text holds =
  let with_symbol symbol =
    Option.bind (split_at (" " ^ symbol ^ " ") text) (fun (left, right) ->
        match float_of_string_opt left, float_of_string_opt right with
        | None, Some x -> Option.map (fun r -> (left, r)) (range symbol x holds)
        | Some x, None -> Option.map (fun r -> (right, r)) (range (mirrored symbol) x holds)
        | None, None | Some _, Some _ -> None)
  in
  List.find_map with_symbol [ "<"; ">"; "==" ]

let is_empty { least; most } =
  least.value > most.value || (least.value = most.value && not (least.closed && most.closed))

let common a b =
  let least =
    if a.least.value > b.least.value || (a.least.value = b.least.value && not a.least.closed) then a.least else b.least
  and most =
    if a.most.value < b.most.value || (a.most.value = b.most.value && not a.most.closed) then a.most else b.most
  in
  { least; most }

let contradict (text, holds) (text', holds') =
  if String.equal text text' then holds <> holds'
  else
    match ranged text holds, ranged text' holds' with
    | Some (x, r), Some (y, r') -> String.equal x y && is_empty (common r r')
    | _, _ -> false

let is_kept_by_growth ~of_operand (text, holds) =
  match ranged text holds with
  | Some (operand, r) -> String.equal operand of_operand && r.most.value = infinity
  | None -> false

let negated text =
  let other (symbol, negation) =
    Option.map (fun (left, right) -> Printf.sprintf "%s %s %s" left negation right) (split_at symbol text) in
  match List.find_map other [ (" < ", ">="); (" > ", "<="); (" == ", "!=") ] with
  | Some text -> text
  | None -> Printf.sprintf "!(%s)" text
