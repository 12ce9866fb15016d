(* In a quoted string of dot, backslashes start escapes, and a line feed is [\n]. Other control characters, and bytes
   that are not UTF-8, are replaced. *)
let quoted text =
  let text = String.concat "\n" (List.map Dolphin_utf8.Utf8.line (String.split_on_char '\n' text)) in
  let b = Buffer.create (String.length text + 2) in
  Buffer.add_char b '"';
  String.iter
    (function
      | '"' -> Buffer.add_string b "\\\""
      | '\\' -> Buffer.add_string b "\\\\"
      | '\n' -> Buffer.add_string b "\\n"
      | c -> Buffer.add_char b c)
    text;
  Buffer.add_char b '"';
  Buffer.contents b

let write ?(name = "lts") out g =
  let labels = Array.init (Graph.labels g) (fun l -> quoted (Graph.label g l)) in
  let text = Option.value (Graph.text g) ~default:string_of_int in
  out (Printf.sprintf "digraph %s {\n  node [shape=box, style=rounded];\n" (quoted name));
  out (Printf.sprintf "  initial [shape=point, label=\"\"];\n  initial -> %d;\n" (Graph.initial g));
  for s = 0 to Graph.states g - 1 do
    let ends = if Graph.degree g s = 0 then ", peripheries=2" else "" in
    out (Printf.sprintf "  %d [label=%s%s];\n" s (quoted (text s)) ends)
  done;
  Graph.iter g (fun s l s' -> out (Printf.sprintf "  %d -> %d [label=%s];\n" s s' labels.(l)));
  out "}\n"

let to_string ?name g =
  let b = Buffer.create (64 * (Graph.transitions g + 1)) in
  write ?name (Buffer.add_string b) g;
  Buffer.contents b
