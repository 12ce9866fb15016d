type t = { start : Lexing.position; stop : Lexing.position }

let none = { start = Lexing.dummy_pos; stop = Lexing.dummy_pos }
let make (start, stop) = { start; stop }
let file at = at.start.Lexing.pos_fname
let line at = at.start.Lexing.pos_lnum
let column at = at.start.Lexing.pos_cnum - at.start.Lexing.pos_bol + 1
let pp ppf at = Format.fprintf ppf "%s:%d:%d" (file at) (line at) (column at)
