(* The length of the character at [i], or 0. A zero byte is a character, though not one of program files. *)
let character text i = if text.[i] = '\000' then 1 else Dolphin_syntax.Text.character text i

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
