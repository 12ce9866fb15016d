open Ast
module Utf8 = Dolphin_utf8.Utf8

(* {1 Precedence}

   An expression stands without parentheses where its level is at least the one asked for. *)

let whole = 0          (* where [waitFor { } then t] may stand bare *)
let conditional = 1
let unary = 12
let power = 13
let step = 14          (* [x++] *)
let postfix = 15

let level_of_operator = function
  | Or -> 2
  | And -> 3
  | Parallel -> 4
  | Around -> 5
  | Intersect -> 6
  | Equal | Not_equal -> 7
  | Less | Less_equal | Greater | Greater_equal | Member_of -> 8
  | Sequence | Append -> 9
  | Add | Subtract -> 10
  | Multiply | Divide | Remainder -> 11
  | Power -> power

let range = level_of_operator Sequence

let level e =
  match e.it with
  | When _ | Wait_for _ | Until _ | During _ | Watch _ | Ensure _ | Repeat _ | Recruit _ -> whole
  | Conditional _ | Elvis _ -> conditional
  | Binary (operator, _, _) -> level_of_operator operator
  | Range _ -> range
  | Unary _ -> unary
  | Increment _ -> step
  | Integer n when n < 0 -> unary
  | Number x when x < 0. -> unary
  | Null | Boolean _ | Integer _ | Number _ | String _ | Template _ | Variable _ | Wildcard | List _ | Map _
  | Closure _ | Call _ | Member _ | Index _ | Builder _ | Pick_else _ -> postfix

let operator = function
  | Divide -> "/"
  | Multiply -> "*"
  | Remainder -> "%"
  | Power -> "**"
  | Add -> "+"
  | Subtract -> "-"
  | Sequence -> ">>"
  | Append -> "<<"
  | Less -> "<"
  | Less_equal -> "<="
  | Greater -> ">"
  | Greater_equal -> ">="
  | Equal -> "=="
  | Not_equal -> "!="
  | Member_of -> "in"
  | Intersect -> "&"
  | Around -> "^"
  | Parallel -> "|"
  | And -> "&&"
  | Or -> "||"

let until = function Completes -> "until" | Fails -> "assure"
let during = function Completes -> "during" | Fails -> "within"

let builder = function
  | Pick -> "pick"
  | Imc_plan -> "imcPlan"
  | Mission -> "mission"
  | Pos -> "pos"
  | All_of -> "allOf"
  | One_of -> "oneOf"
  | Recruit -> "recruit"

(* {1 Words and texts} *)

(* The code of the character of [n] bytes, two or three, at [i]. *)
let code text i n =
  let byte k = Char.code text.[i + k] in
  let tail k = byte k land 0x3F in
  if n = 2 then ((byte 0 land 0x1F) lsl 6) lor tail 1 else ((byte 0 land 0x0F) lsl 12) lor (tail 1 lsl 6) lor tail 2

let escaped ~quote text =
  let buffer = Buffer.create (String.length text + 8) in
  let add = function
    | '\\' -> Buffer.add_string buffer "\\\\"
    | '\n' -> Buffer.add_string buffer "\\n"
    | '\t' -> Buffer.add_string buffer "\\t"
    | '\r' -> Buffer.add_string buffer "\\r"
    | '$' when quote = '"' -> Buffer.add_string buffer "\\$"
    | c when c = quote -> Buffer.add_char buffer '\\'; Buffer.add_char buffer c
    | c when c < ' ' || c = '\x7F' -> Printf.bprintf buffer "\\u%04x" (Char.code c)
    | c -> Buffer.add_char buffer c
  in
  (* Characters of two bytes and more that people could not see, or that would reorder the line. *)
  let rec from i =
    if i < String.length text then
      match Utf8.length text i with
      | (2 | 3) as n when Utf8.is_unfit text i ->
        Printf.bprintf buffer "\\u%04x" (code text i n);
        from (i + n)
      | _ -> add text.[i]; from (i + 1)
  in
  from 0;
  Buffer.contents buffer

let quoted text = "'" ^ escaped ~quote:'\'' text ^ "'"

let is_name text =
  let letter = function 'a' .. 'z' | 'A' .. 'Z' | '_' -> true | _ -> false in
  let follows = function '0' .. '9' -> true | c -> letter c in
  text <> "" && letter text.[0]
  && (let rec all i = i = String.length text || follows text.[i] && all (i + 1) in all 1)

let key_name text =
  if is_name text && not (List.mem text [ "true"; "false"; "null" ]) then text else quoted text

(* The shortest decimal that is read as [x]. *)
let decimal x =
  let text =
    let rec shortest digits =
      let text = Printf.sprintf "%.*g" digits x in
      if digits >= 17 || float_of_string text = x then text else shortest (digits + 1)
    in
    shortest 1
  in
  if String.contains text '.' || String.contains text 'e' then text else text ^ ".0"
