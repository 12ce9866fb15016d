type t = { line : int; character : int }

(* How many code units of UTF-16 the character that begins with byte [c] has; 0 for the bytes after the first. *)
let units c =
  let c = Char.code c in
  if c land 0xC0 = 0x80 then 0 else if c >= 0xF0 then 2 else 1

let of_offset text n =
  let rec go i line character =
    if i >= n || i >= String.length text then { line; character }
    else if text.[i] = '\n' then go (i + 1) (line + 1) 0
    else go (i + 1) line (character + units text.[i])
  in
  go 0 0 0

let to_offset text p =
  let length = String.length text in
  let rec line_start i line =
    if line = 0 then i
    else
      match String.index_from_opt text i '\n' with
      | Some n -> line_start (n + 1) (line - 1)
      | None -> length
  in
  let rec along i left =
    if i >= length || text.[i] = '\n' then i
    else if units text.[i] = 0 then along (i + 1) left
    else if left <= 0 then i
    else along (i + 1) (left - units text.[i])
  in
  along (line_start 0 p.line) p.character
