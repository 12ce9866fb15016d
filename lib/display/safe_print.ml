open Dolphin_trace

let line text = print_endline (Phrase.harmless text)

let print text =
  print_string (Phrase.harmless text);
  flush stdout

let f format = Printf.ksprintf print format
let pp format = Format.kasprintf print format
