module Phrase = Dolphin_trace.Phrase

let narrowest = 16

(* The lines that [words] make, each of at most [room] characters. *)
let rec fill room line = function
  | [] -> if line = "" then [] else [ line ]
  | word :: rest when Phrase.width word > room ->
    let first, left = Phrase.split room word in
    if line = "" then first :: fill room "" (left :: rest) else line :: fill room "" (word :: rest)
  | word :: rest ->
    let longer = if line = "" then word else line ^ " " ^ word in
    if Phrase.width longer <= room then fill room longer rest else line :: fill room word rest

let filled ~columns text =
  let words = List.filter (fun word -> word <> "") (String.split_on_char ' ' (Phrase.one_line text)) in
  fill (max narrowest columns) "" words

let lines ~columns ~head text =
  match filled ~columns:(columns - Phrase.width head) text with
  | [] -> [ head ]
  | first :: rest -> (head ^ first) :: List.map (fun line -> String.make (Phrase.width head) ' ' ^ line) rest

let hanging ~columns text =
  match filled ~columns:(columns - 2) text with
  | [] -> [ "" ]
  | first :: rest -> first :: List.map (fun line -> "  " ^ line) rest
