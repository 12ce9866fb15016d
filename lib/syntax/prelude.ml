let name = "prelude"
let file = "<prelude>"
let text = Prelude_text.text

type entry = { name : string; form : string; text : string; example : string; law : (string * string) option;
               weak_law : (string * string) option }

(* {1 Comments} *)

(* The blocks of lines of [text] between empty lines. *)
let blocks text =
  let add line (block, blocks) =
    if line = "" then ([], if block = [] then blocks else block :: blocks) else (line :: block, blocks) in
  let block, blocks = List.fold_right add (String.split_on_char '\n' text) ([], []) in
  if block = [] then blocks else block :: blocks

let after prefix line =
  let n = String.length prefix in
  if String.length line >= n && String.sub line 0 n = prefix then Some (String.sub line n (String.length line - n))
  else None

let comment block = List.filter_map (after "// ") block

(* [a] and [b] of [a SEPARATOR b], at the first separator. *)
let cut separator line =
  let n = String.length separator in
  let rec from i =
    if i + n > String.length line then None
    else if String.sub line i n = separator then
      Some (String.sub line 0 i, String.sub line (i + n) (String.length line - i - n))
    else from (i + 1) in
  from 0

let weak = "Weak law: "

let entry block =
  let lines = comment block in
  let told prefix = List.find_map (after prefix) lines in
  let is_prose line = List.for_all (fun prefix -> after prefix line = None) [ "Example: "; "Law: "; weak ] in
  match cut ": " (String.concat " " (List.filter is_prose lines)), told "Example: " with
  | Some (form, text), Some example ->
    let name = match cut "(" form with Some (name, _) -> name | None -> form in
    Some { name; form; text = String.capitalize_ascii text; example; law = Option.bind (told "Law: ") (cut " is ");
           weak_law = Option.bind (told weak) (cut " is ") }
  | _, _ -> None

let known = lazy (List.filter_map entry (blocks text))
let entries () = Lazy.force known

let find name = List.find_opt (fun (e : entry) -> e.name = name) (entries ())

(* {1 The page} *)

(* In lines of at most 120 characters. *)
let filled text =
  let add (line, lines) word =
    if line = "" then (word, lines)
    else if String.length line + 1 + String.length word > 120 then (word, line :: lines)
    else (line ^ " " ^ word, lines) in
  let last, lines = List.fold_left add ("", []) (String.split_on_char ' ' text) in
  String.concat "\n" (List.rev (last :: lines))

let section ({ form; text; example; law; weak_law; name = _ } : entry) =
  let line prefix (a, b) = "\n" ^ filled (Printf.sprintf "%s`%s` is `%s`." prefix a b) ^ "\n" in
  let told prefix = Option.fold ~none:"" ~some:(line prefix) in
  Printf.sprintf "## `%s`\n\n%s\n\n```groovy\n%s\n```\n%s%s" form (filled text) example (told "Law: " law)
    (told weak weak_law)

let manual () =
  let introduction = String.concat " " (comment (List.hd (blocks text))) in
  String.concat "\n" (("# The prelude\n\n" ^ filled introduction ^ "\n") :: List.map section (entries ()))
