let length text i =
  let last = String.length text in
  let byte k = if i + k < last then Char.code (String.unsafe_get text (i + k)) else 0 in
  let next k low high = byte k >= low && byte k <= high in
  let tail k = next k 0x80 0xBF in
  if i < 0 || i >= last then 0
  else
    match byte 0 with
    | c when c < 0x80 -> 1
    | c when c >= 0xC2 && c <= 0xDF -> if tail 1 then 2 else 0
    | 0xE0 -> if next 1 0xA0 0xBF && tail 2 then 3 else 0
    | 0xED -> if next 1 0x80 0x9F && tail 2 then 3 else 0
    | c when c >= 0xE1 && c <= 0xEF -> if tail 1 && tail 2 then 3 else 0
    | 0xF0 -> if next 1 0x90 0xBF && tail 2 && tail 3 then 4 else 0
    | 0xF4 -> if next 1 0x80 0x8F && tail 2 && tail 3 then 4 else 0
    | c when c >= 0xF1 && c <= 0xF3 -> if tail 1 && tail 2 && tail 3 then 4 else 0
    | _ -> 0

let is_control text i =
  match text.[i] with
  | '\x00' .. '\x1F' | '\x7F' -> true
  | '\xC2' -> i + 1 < String.length text && text.[i + 1] >= '\x80' && text.[i + 1] <= '\x9F'
  | _ -> false

let is_unfit text i =
  let second = if i + 1 < String.length text then text.[i + 1] else ' ' in
  let third = if i + 2 < String.length text then text.[i + 2] else ' ' in
  match text.[i], second with
  | '\xE2', '\x80' -> third >= '\xA8' && third <= '\xAE'
  | '\xE2', '\x81' -> third >= '\xA6' && third <= '\xA9'
  | '\xEF', '\xBF' -> third = '\xBE' || third = '\xBF'
  | _ -> is_control text i

let is_valid text =
  let rec from i = i >= String.length text || match length text i with 0 -> false | n -> from (i + n) in
  from 0

let replacement = "\xEF\xBF\xBD"

(* Each byte that belongs to no character is replaced, and each character that is [odd]. *)
let replace ~odd text =
  let buffer = Buffer.create (String.length text + 16) in
  let rec from i =
    if i < String.length text then
      match length text i with
      | 0 -> Buffer.add_string buffer replacement; from (i + 1)
      | n when odd text i -> Buffer.add_string buffer replacement; from (i + n)
      | n -> Buffer.add_substring buffer text i n; from (i + n)
  in
  from 0;
  Buffer.contents buffer

let repaired text = if is_valid text then text else replace ~odd:(fun _ _ -> false) text

let strays text =
  let rec from i count =
    if i >= String.length text then count
    else match length text i with 0 -> from (i + 1) (count + 1) | n -> from (i + n) count
  in
  from 0 0

let is_line text =
  let rec from i =
    i >= String.length text
    || match length text i with 0 -> false | n -> (not (is_unfit text i)) && from (i + n)
  in
  from 0

let line text = if is_line text then text else replace ~odd:is_unfit text
