module Phrase = Dolphin_trace.Phrase

let rec trimmed text =
  let n = String.length text in
  if n > 0 && text.[n - 1] = ' ' then trimmed (String.sub text 0 (n - 1)) else text

(* How many cells stand in each line of a row: as many as fit, one at least; those after the first line are indented. *)
let in_lines columns widths =
  let add (lines, count, used) width =
    let longer = used + 2 + width in
    if count > 0 && longer > columns then (count :: lines, 1, 2 + width) else (lines, count + 1, longer)
  in
  let lines, count, _ = List.fold_left add ([], 0, -2) widths in
  List.rev (count :: lines)

let rec taken n xs = match xs with x :: rest when n > 0 -> x :: taken (n - 1) rest | _ -> []
let rec left n xs = match xs with _ :: rest when n > 0 -> left (n - 1) rest | xs -> xs

let rec folded indent counts cells =
  match counts with
  | [] -> []
  | n :: counts ->
    let line = trimmed (indent ^ String.concat "  " (taken n cells)) in
    let others = folded "  " counts (left n cells) in
    if line = "" && indent <> "" then others else line :: others

let lines ?columns heads rows =
  let rows = heads :: List.map (List.map Phrase.one_line) rows in
  let wider = List.map2 (fun width cell -> max width (Phrase.width cell)) in
  let widths = List.fold_left wider (List.map (fun _ -> 0) heads) rows in
  let counts =
    match columns with Some columns -> in_lines columns widths | None -> [ List.length heads ] in
  List.concat_map (fun cells -> folded "" counts (List.map2 Phrase.pad widths cells)) rows
