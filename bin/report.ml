module Diagnostic = Dolphin_syntax.Diagnostic

let complain sentence = Format.eprintf "dolphin: %s@." sentence

let diagnostics ~source ds =
  let ordered = List.stable_sort Diagnostic.compare ds in
  List.iter (fun d -> Format.eprintf "%a@." (Diagnostic.pp ~source) d) ordered

let count n what = Printf.sprintf "%d %s%s" n what (if n = 1 then "" else "s")

let counts ds =
  let is_error (d : Diagnostic.t) = match d.severity with Error -> true | Warning -> false in
  let errors, warnings = List.partition is_error ds in
  let first = if errors = [] then "no errors" else count (List.length errors) "error" in
  if warnings = [] then first else first ^ ", " ^ count (List.length warnings) "warning"
