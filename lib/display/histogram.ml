module Phrase = Dolphin_trace.Phrase

let longest = 100
let shortest = 10

let lines ~columns bars =
  let widest f = List.fold_left (fun n bar -> max n (Phrase.width (f bar))) 0 bars in
  let number (_, n) = string_of_int n in
  let names = widest fst and numbers = widest number in
  let most = List.fold_left (fun n (_, m) -> max n m) 1 bars in
  let room = max shortest (min longest (columns - names - numbers - 4)) in
  let line ((name, n) as bar) =
    let length = if n = 0 then 0 else max 1 (((n * room) + (most / 2)) / most) in
    let text = Printf.sprintf "%s  %*s" (Phrase.pad names name) numbers (number bar) in
    if length = 0 then text else text ^ "  " ^ String.make length '#'
  in
  List.map line bars
