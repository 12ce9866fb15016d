(* The length of the well-formed UTF-8 character at [i], or 0. *)
let length source i =
  let last = String.length source in
  let byte k = if i + k < last then Char.code source.[i + k] else 0 in
  let next k low high = byte k >= low && byte k <= high in
  let tail k = next k 0x80 0xBF in
  match byte 0 with
  | 0 -> 0
  | c when c < 0x80 -> 1
  | c when c >= 0xC2 && c <= 0xDF -> if tail 1 then 2 else 0
  | 0xE0 -> if next 1 0xA0 0xBF && tail 2 then 3 else 0
  | 0xED -> if next 1 0x80 0x9F && tail 2 then 3 else 0
  | c when c >= 0xE1 && c <= 0xEF -> if tail 1 && tail 2 then 3 else 0
  | 0xF0 -> if next 1 0x90 0xBF && tail 2 && tail 3 then 4 else 0
  | 0xF4 -> if next 1 0x80 0x8F && tail 2 && tail 3 then 4 else 0
  | c when c >= 0xF1 && c <= 0xF3 -> if tail 1 && tail 2 && tail 3 then 4 else 0
  | _ -> 0

let is_control source i n =
  match source.[i] with
  | c when Char.code c < 0x20 || c = '\x7F' -> true
  | '\xC2' -> n = 2 && source.[i + 1] < '\xA0'
  | _ -> false

let printable text =
  let buffer = Buffer.create (String.length text) in
  let rec from i =
    if i < String.length text then
      match length text i with
      | 1 when text.[i] = '\n' -> Buffer.add_char buffer '\n'; from (i + 1)
      | 0 -> Buffer.add_char buffer '?'; from (i + 1)
      | n when is_control text i n -> Buffer.add_char buffer '?'; from (i + n)
      | n -> Buffer.add_substring buffer text i n; from (i + n)
  in
  from 0;
  Buffer.contents buffer
