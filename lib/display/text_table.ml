module Phrase = Dolphin_trace.Phrase

let rec trimmed text =
  let n = String.length text in
  if n > 0 && text.[n - 1] = ' ' then trimmed (String.sub text 0 (n - 1)) else text

let lines heads rows =
  let rows = heads :: List.map (List.map Phrase.one_line) rows in
  let wider = List.map2 (fun width cell -> max width (Phrase.width cell)) in
  let widths = List.fold_left wider (List.map (fun _ -> 0) heads) rows in
  List.map (fun cells -> trimmed (String.concat "  " (List.map2 Phrase.pad widths cells))) rows
