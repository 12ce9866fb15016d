type t =
  | Integer of int
  | Boolean of bool
  | String of string
  | Tuple of t list
  | Record of (string * t) list
  | Set of t list
  | Name of string

let least = -0x7FFFFFFF
let greatest = 0x7FFFFFFF
let strings texts = Tuple (List.map (fun text -> String text) texts)

let escaped text =
  let b = Buffer.create (String.length text + 2) in
  let add = function
    | '"' -> Buffer.add_string b "\\\""
    | '\\' -> Buffer.add_string b "\\\\"
    | '\n' -> Buffer.add_string b "\\n"
    | '\t' -> Buffer.add_string b "\\t"
    | '\r' -> Buffer.add_string b "\\r"
    | '\012' -> Buffer.add_string b "\\f"
    | c -> Buffer.add_char b c
  in
  String.iter add text;
  Buffer.contents b

let rec pp ppf e =
  let print format = Format.fprintf ppf format in
  let commas pp = Fmt.list ~sep:(Fmt.any ", ") pp in
  match e with
  | Integer i -> print "%d" i
  | Boolean true -> print "TRUE"
  | Boolean false -> print "FALSE"
  | String text -> print "\"%s\"" (escaped text)
  | Tuple [] -> print "<< >>"
  | Tuple es -> print "<< %a >>" (commas pp) es
  | Record fields -> print "[ %a ]" (commas (fun ppf (name, e) -> Format.fprintf ppf "%s |-> %a" name pp e)) fields
  | Set [] -> print "{ }"
  | Set es -> print "{ %a }" (commas pp) es
  | Name name -> print "%s" name

let comment text = String.concat " " (String.split_on_char '\n' (Dolphin_syntax.Character.printable text))
