module Utf8 = Dolphin_utf8.Utf8

(* A zero byte stands in no program. *)
let length source i = if i < String.length source && source.[i] = '\000' then 0 else Utf8.length source i

let printable text =
  let buffer = Buffer.create (String.length text) in
  let rec from i =
    if i < String.length text then
      match length text i with
      | 1 when text.[i] = '\n' -> Buffer.add_char buffer '\n'; from (i + 1)
      | 0 -> Buffer.add_char buffer '?'; from (i + 1)
      | n when Utf8.is_unfit text i -> Buffer.add_char buffer '?'; from (i + n)
      | n -> Buffer.add_substring buffer text i n; from (i + n)
  in
  from 0;
  Buffer.contents buffer
