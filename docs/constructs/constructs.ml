open Dolphin_syntax
open Dolphin_service

let read path =
  let channel = open_in_bin path in
  let text = really_input_string channel (in_channel_length channel) in
  close_in channel;
  text

(* [words] with [between] them, in lines of at most 116 characters that begin with [margin]. *)
let filled ~margin ~between words =
  let add lines word =
    match lines with
    | line :: lines when String.length line + String.length between + String.length word <= 116 ->
      (line ^ between ^ word) :: lines
    | lines -> (margin ^ word) :: lines
  in
  List.rev (List.fold_left add [] words)

(* [page] with these lines instead of all that begin with their prefix. *)
let with_lines groups page =
  let add (lines, left) line =
    match List.find_opt (fun (prefix, _) -> String.starts_with ~prefix line) groups with
    | Some (prefix, made) when List.mem_assoc prefix left -> (List.rev_append made lines, List.remove_assoc prefix left)
    | Some _ -> (lines, left)
    | None -> (line :: lines, left)
  in
  let lines, _ = List.fold_left add ([], groups) (String.split_on_char '\n' page) in
  String.concat "\n" (List.rev lines)

(* {1 Rules} *)

let constructor rule =
  let letter i c = if c = '-' then '_' else if i = 0 then c else Char.lowercase_ascii c in
  String.mapi letter rule

let with_rules = List.filter (fun (row : Construct.t) -> row.rules <> []) Construct.all
let origin = "(* Made of lib/syntax/construct.ml: dune promote brings it up to date. *)\n"

let rule_type ~comments =
  let line (row : Construct.t) =
    let rules = "  | " ^ String.concat " | " (List.map constructor row.rules) in
    if comments then Printf.sprintf "%s  (* %s *)\n" rules row.name else rules ^ "\n" in
  "type t =\n" ^ String.concat "" (List.map line with_rules)

let rule_ml () =
  let name rule = Printf.sprintf "%s -> %S" (constructor rule) rule in
  let names (row : Construct.t) = filled ~margin:"  | " ~between:" | " (List.map name row.rules) in
  let list = function [] -> [] | first :: rest -> ("[ " ^ first) :: rest in
  let all = filled ~margin:"    " ~between:"; " (List.map constructor Construct.rules) in
  let all = list (List.map String.trim all) in
  String.concat ""
    [ origin; "\n"; rule_type ~comments:false; "\nlet all =\n  "; String.concat ";\n    " all; " ]\n";
      "\nlet name = function\n"; String.concat "\n" (List.concat_map names with_rules); "\n";
      "\nlet of_name text = List.find_opt (fun rule -> name rule = text) all\n";
      "let pp ppf rule = Format.pp_print_string ppf (name rule)\n" ]

let rule_mli () =
  String.concat ""
    [ origin; "\n(** The names of the inference rules, as in docs/semantics.md. *)\n\n"; rule_type ~comments:true;
      "\nval all : t list\n(** Every rule, once. *)\n";
      "\nval name : t -> string\n(** [name r] is [r] as the documentation spells it: [\"PAR-ERR\"]. *)\n";
      "\nval of_name : string -> t option\n(** The rule that {!name} spells so. *)\n";
      "\nval pp : Format.formatter -> t -> unit\n(** {!name}. *)\n" ]

(* An action of TLA+ for each rule, and their disjunction. *)
let actions page =
  let spelt rule = String.map (function '-' -> '_' | c -> c) rule in
  let definition rule =
    Printf.sprintf {|Take_%s(ts) == \E j \in Taking("%s", ts) : Unmarked(ts[j])|} (spelt rule) rule in
  let disjunct rule = "Take_" ^ spelt rule ^ "(ts)" in
  let disjuncts = filled ~margin:{|     \/ |} ~between:{| \/ |} (List.map disjunct Construct.rules) in
  with_lines [ ("Take_", List.map definition Construct.rules); ({|     \/ Take_|}, disjuncts) ] page

(* {1 Words} *)

let once words = List.rev (List.fold_left (fun seen x -> if List.mem x seen then seen else x :: seen) [] words)

(* The spellings of the words for which [f row word] is true. *)
let words f =
  let of_row (row : Construct.t) = List.filter (f row) row.words in
  once (List.map (fun (word : Construct.word) -> word.spelling) (List.concat_map of_row Construct.all))

(* Whether the construct makes a task of other tasks. *)
let composes (row : Construct.t) =
  let is_task (part : Construct.part) =
    match part.kind with
    | Task | Later | Maker -> true
    | Guard | Code | Handler | Duration | Number | Text | Pairs | Vehicles | Settings -> false in
  List.exists is_task row.parts

let control = words (fun _ word -> word.place = Control)

let composing =
  words (fun row word ->
      match word.place with
      | Begins | Limits | Begins_or_limits | Joins -> true
      | Block -> composes row
      | Control | Defines | Declares | Constant | Procedure | Task_procedure -> false)

let names entries = List.map (fun (entry : Vocabulary.entry) -> entry.name) entries

let task_procedures =
  let gives_task = words (fun _ word -> word.place = Task_procedure) in
  once (gives_task @ List.filter (fun x -> not (List.mem x composing)) (names Vocabulary.blocks))

let procedures =
  once (List.filter (fun x -> not (List.mem x task_procedures)) (names Vocabulary.procedures))

let vim page =
  let group (name, words) =
    let keyword = "syntax keyword " ^ name ^ " " in
    (keyword, filled ~margin:keyword ~between:" " words)
  in
  let groups =
    [ ("dolphinOperatorWord", composing); ("dolphinTask", task_procedures); ("dolphinProcedure", procedures) ] in
  with_lines (List.map group groups) page

let rec find text part from =
  if String.length part + from > String.length text then failwith ("no " ^ part)
  else if String.sub text from (String.length part) = part then from
  else find text part (from + 1)

(* [text] with [made] between [opening] and the next [ending], after [from]. *)
let replace text ~from opening ending made =
  let start = find text opening from + String.length opening in
  let stop = find text ending start in
  String.sub text 0 start ^ made ^ String.sub text stop (String.length text - stop)

let vscode page =
  let add page (scope, words) =
    let from = find page (Printf.sprintf {|"name": "%s"|} scope) 0 in
    replace page ~from {|\\b(|} {|)\\b|} (String.concat "|" words)
  in
  List.fold_left add page
    [ ("keyword.control.dolphin", control); ("keyword.control.task.dolphin", composing);
      ("support.function.task.dolphin", task_procedures); ("support.function.dolphin", procedures) ]

let of_constructs = words (fun _ word -> word.place <> Constant)
let constants = words (fun _ word -> word.place = Constant)

let typescript () =
  let list name words =
    let lines = filled ~margin:"  " ~between:" " words in
    Printf.sprintf "export const %s = `\n%s`.trim().split(/\\s+/);\n" name (String.concat "\n" lines) in
  "// Made of lib/syntax/construct.ml: dune promote brings it up to date.\n\n" ^ list "words" of_constructs ^ "\n"
  ^ list "constants" constants

(* {1 The manual} *)

let cell text = String.concat {|\||} (String.split_on_char '|' text)

let table () =
  let part (p : Construct.part) = Construct.kind_name p.kind ^ if p.many then "s" else "" in
  let line (row : Construct.t) (word : Construct.word) =
    Printf.sprintf "| `%s` | %s | %s | %s |\n" (cell word.form) (cell word.text)
      (String.concat ", " (List.map part row.parts))
      (String.concat ", " row.rules) in
  let is_shown (word : Construct.word) = match word.place with Joins | Constant -> false | _ -> true in
  let rows (row : Construct.t) = List.map (line row) (List.filter is_shown row.words) in
  "| Form | Meaning | Parts | Rules |\n| --- | --- | --- | --- |\n"
  ^ String.concat "" (List.concat_map rows Construct.all)

let manual page = replace page ~from:0 "<!-- constructs -->\n" "<!-- end of constructs -->" (table ())

let () =
  print_string
    (match Array.to_list Sys.argv with
     | [ _; "rule.ml" ] -> rule_ml ()
     | [ _; "rule.mli" ] -> rule_mli ()
     | [ _; "words.ts" ] -> typescript ()
     | [ _; "actions"; path ] -> actions (read path)
     | [ _; "vim"; path ] -> vim (read path)
     | [ _; "vscode"; path ] -> vscode (read path)
     | [ _; "manual"; path ] -> manual (read path)
     | _ -> failwith "usage: constructs.exe (rule.ml | rule.mli | words.ts | (actions | vim | vscode | manual) FILE)")
