open Dolphin_trace

let line text = print_endline (Phrase.harmless text)

let print text =
  print_string (Phrase.harmless text);
  flush stdout

let printf format = Printf.ksprintf print format
let format format = Format.kasprintf print format
