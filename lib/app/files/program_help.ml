open Dolphin_syntax

(* {1 The comment at the top} *)

let drop n line = String.sub line n (String.length line - n)
let starts prefix line = String.length line >= String.length prefix && String.sub line 0 (String.length prefix) = prefix

(* A line of a comment without what marks it as one. *)
let bare line =
  let line = String.trim line in
  let line = if starts "//" line then drop 2 line else if starts "*" line then drop 1 line else line in
  if starts " " line then drop 1 line else line

let rec of_slashes = function
  | line :: rest when starts "//" (String.trim line) -> bare line :: of_slashes rest
  | _ -> []

(* The text up to the end of a comment that began with a slash and an asterisk. *)
let of_block text =
  let rec stop i =
    if i + 1 >= String.length text then String.length text
    else if text.[i] = '*' && text.[i + 1] = '/' then i
    else stop (i + 1)
  in
  String.split_on_char '\n' (String.sub text 0 (stop 0))

let is_blank line = String.trim line = ""
let rec skip_blank = function line :: rest when is_blank line -> skip_blank rest | lines -> lines
let trimmed lines = List.rev (skip_blank (List.rev (skip_blank lines)))

let comment source =
  match skip_blank (String.split_on_char '\n' source) with
  | first :: rest when starts "/*" (String.trim first) ->
    let text = String.concat "\n" (String.trim first :: rest) in
    trimmed (List.map (fun line -> bare (String.trim line)) (of_block (drop 2 text)))
  | lines -> of_slashes lines

(* {1 All of it} *)

let section title = function [] -> [] | lines -> [ title ] @ lines @ [ "" ]

let parameters found =
  let spelt = List.map (Format.asprintf "%a" Parameters.pp) found in
  let width = List.fold_left (fun n text -> max n (String.length text)) 0 spelt in
  List.map2
    (fun text (p : Parameters.t) ->
       match p.description with
       | Some why -> Printf.sprintf "  %-*s   %s" width text why
       | None -> "  " ^ text)
    spelt found

let input (program : Dolphin_semantics.Core.program) key =
  Printf.sprintf "  '%s'%s" key (if List.mem key program.vehicle_inputs then ", of a vehicle" else "")

let lines (p : Program_file.t) =
  let own = comment p.source in
  let inputs = List.map (input p.program) p.program.inputs in
  let said =
    (if own = [] then [] else own @ [ "" ])
    @ section "Parameters, which --set NAME=VALUE gives other values:" (parameters p.parameters)
    @ section "Inputs, which dolphin post posts to a run:" inputs
  in
  trimmed (if p.parameters = [] && inputs = [] then said @ [ "It has no parameters and no inputs." ] else said)
