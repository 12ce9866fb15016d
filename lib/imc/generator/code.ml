type t = Line of string | Nest of t list

let line format = Printf.ksprintf (fun text -> Line text) format
let under head body = [ Line head; Nest body ]
let enclosed head body foot = under head body @ [ Line foot ]

let paragraphs parts =
  match List.filter (fun part -> part <> []) parts with
  | [] -> []
  | first :: rest -> first @ List.concat_map (fun part -> Line "" :: part) rest

let to_string code =
  let buffer = Buffer.create 65536 in
  let rec add indent = function
    | Line "" -> Buffer.add_char buffer '\n'
    | Line text -> Printf.bprintf buffer "%s%s\n" indent text
    | Nest code -> List.iter (add (indent ^ "  ")) code
  in
  List.iter (add "") code;
  Buffer.contents buffer
