(* The length of the character at [i], or 0 if none begins there: table 3-7 of the Unicode standard. *)
let character text i =
  let byte n = if i + n < String.length text then Char.code text.[i + n] else 0 in
  let follows n = byte n land 0xC0 = 0x80 in
  let second low high = low <= byte 1 && byte 1 <= high in
  match byte 0 with
  | b when b < 0x80 -> 1
  | b when 0xC2 <= b && b <= 0xDF && follows 1 -> 2
  | 0xE0 when second 0xA0 0xBF && follows 2 -> 3
  | 0xED when second 0x80 0x9F && follows 2 -> 3
  | b when 0xE1 <= b && b <= 0xEF && b <> 0xED && follows 1 && follows 2 -> 3
  | 0xF0 when second 0x90 0xBF && follows 2 && follows 3 -> 4
  | 0xF4 when second 0x80 0x8F && follows 2 && follows 3 -> 4
  | b when 0xF1 <= b && b <= 0xF3 && follows 1 && follows 2 && follows 3 -> 4
  | _ -> 0

let is_valid text =
  let rec from i =
    i >= String.length text
    || match character text i with 0 -> false | n -> from (i + n)
  in
  from 0

let replacement = "\xEF\xBF\xBD"

let repaired text =
  if is_valid text then text
  else begin
    let buffer = Buffer.create (String.length text + 16) in
    let rec from i =
      if i < String.length text then
        match character text i with
        | 0 -> Buffer.add_string buffer replacement; from (i + 1)
        | n -> Buffer.add_substring buffer text i n; from (i + n)
    in
    from 0;
    Buffer.contents buffer
  end
