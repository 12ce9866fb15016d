type t = Yojson.Safe.t

let int n = `Int n
let int64 n = `Intlit (Int64.to_string n)

let float x =
  match Float.classify_float x with
  | FP_nan -> `String "NaN"
  | FP_infinite -> `String (if x > 0. then "Infinity" else "-Infinity")
  | FP_zero | FP_normal | FP_subnormal -> `Float x

(* [sequence s i] is the length of the well-formed UTF-8 sequence at [i], or 0. Unicode, table 3-7. *)
let sequence s i =
  let byte k = if i + k < String.length s then Char.code s.[i + k] else 0 in
  let within low high k = byte k >= low && byte k <= high in
  let continued k = within 0x80 0xBF k in
  match byte 0 with
  | b when b < 0x80 -> 1
  | b when b >= 0xC2 && b <= 0xDF -> if continued 1 then 2 else 0
  | 0xE0 -> if within 0xA0 0xBF 1 && continued 2 then 3 else 0
  | 0xED -> if within 0x80 0x9F 1 && continued 2 then 3 else 0
  | b when b >= 0xE1 && b <= 0xEF -> if continued 1 && continued 2 then 3 else 0
  | 0xF0 -> if within 0x90 0xBF 1 && continued 2 && continued 3 then 4 else 0
  | b when b >= 0xF1 && b <= 0xF3 -> if continued 1 && continued 2 && continued 3 then 4 else 0
  | 0xF4 -> if within 0x80 0x8F 1 && continued 2 && continued 3 then 4 else 0
  | _ -> 0

let utf_8 s =
  let buffer = Buffer.create (String.length s) in
  let rec add i =
    if i < String.length s then
      match sequence s i with
      | 0 ->
        Buffer.add_utf_8_uchar buffer Uchar.rep;
        add (i + 1)
      | n ->
        Buffer.add_substring buffer s i n;
        add (i + n)
  in
  add 0;
  Buffer.contents buffer

let text s = `String (utf_8 s)

let raw s =
  let hex c = Printf.sprintf "%02x" (Char.code c) in
  `String (String.concat "" (List.map hex (List.of_seq (String.to_seq s))))

let inline show = function None -> `Null | Some m -> show m
let list show ms = `List (List.map show ms)
let message name fields = `Assoc (("abbrev", `String name) :: fields)
