type t = { token : Grammar.token; start : Lexing.position; stop : Lexing.position; newline : bool }

let at t = Location.make (t.start, t.stop)

let text ~source t =
  let first = t.start.Lexing.pos_cnum and last = t.stop.Lexing.pos_cnum in
  String.sub source first (last - first)

let line t = t.start.Lexing.pos_lnum
