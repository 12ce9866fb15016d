type extended = [ Yojson.Safe.t | `Tuple of Yojson.Safe.t list | `Variant of string * Yojson.Safe.t option ]

let number x : Yojson.Safe.t =
  if Float.is_integer x && Float.abs x <= 1e15 then `Int (int_of_float x) else `Float x

let of_float x =
  let text digits = Printf.sprintf "%.*g" digits x in
  let gives_back text = float_of_string text = x in
  let shortest = List.find_opt gives_back [ text 15; text 16 ] in
  let text = Option.value shortest ~default:(text 17) in
  let is_marked c = c = '.' || c = 'e' in
  if String.exists is_marked text then text else text ^ ".0"

(* Control characters are escaped: texts are shown on terminals, too. *)
let write_string buffer text =
  let text = Dolphin_utf8.Utf8.repaired text in
  let character i c =
    match c with
    | '\xc2' when Dolphin_utf8.Utf8.is_control text i -> Printf.bprintf buffer "\\u%04x" (Char.code text.[i + 1])
    | '\x80' .. '\x9f' when i > 0 && text.[i - 1] = '\xc2' -> ()
    | '"' -> Buffer.add_string buffer "\\\""
    | '\\' -> Buffer.add_string buffer "\\\\"
    | '\n' -> Buffer.add_string buffer "\\n"
    | '\t' -> Buffer.add_string buffer "\\t"
    | '\000' .. '\031' | '\127' -> Printf.bprintf buffer "\\u%04x" (Char.code c)
    | c -> Buffer.add_char buffer c
  in
  Buffer.add_char buffer '"';
  String.iteri character text;
  Buffer.add_char buffer '"'

let rec write buffer (json : Yojson.Safe.t) =
  let separated opening item closing items =
    Buffer.add_char buffer opening;
    List.iteri (fun i x -> if i > 0 then Buffer.add_char buffer ','; item x) items;
    Buffer.add_char buffer closing
  in
  match (json :> extended) with
  | `Null -> Buffer.add_string buffer "null"
  | `Bool b -> Buffer.add_string buffer (string_of_bool b)
  | `Int i -> Buffer.add_string buffer (string_of_int i)
  | `Intlit digits -> Buffer.add_string buffer digits
  | `Float x -> Buffer.add_string buffer (if Float.is_finite x then of_float x else "null")
  | `String text -> write_string buffer text
  | `List items | `Tuple items -> separated '[' (write buffer) ']' items
  | `Assoc members ->
    let member (name, x) =
      write_string buffer name;
      Buffer.add_char buffer ':';
      write buffer x
    in
    separated '{' member '}' members
  | `Variant (name, x) -> write buffer (`List (`String name :: Option.to_list x))

let to_string json =
  let buffer = Buffer.create 256 in
  write buffer json;
  Buffer.contents buffer

let shortened n json =
  let text = to_string json in
  if String.length text <= n then text else String.sub text 0 n ^ "..."

(* {1 On several lines} *)

let rec valid (json : Yojson.Safe.t) : Yojson.Safe.t =
  match (json :> extended) with
  | (`Null | `Bool _ | `Int _ | `Intlit _) as x -> x
  | `Float x -> if Float.is_finite x then `Float x else `Null
  | `String text -> `String (Dolphin_utf8.Utf8.repaired text)
  | `List items | `Tuple items -> `List (List.map valid items)
  | `Assoc members -> `Assoc (List.map (fun (name, x) -> (Dolphin_utf8.Utf8.repaired name, valid x)) members)
  | `Variant (name, x) -> `List (`String (Dolphin_utf8.Utf8.repaired name) :: List.map valid (Option.to_list x))

let to_lines json = Yojson.Safe.pretty_to_string (valid json)
