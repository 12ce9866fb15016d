let digit c =
  match c with
  | '0' .. '9' -> Some (Char.code c - Char.code '0')
  | 'a' .. 'f' -> Some (Char.code c - Char.code 'a' + 10)
  | 'A' .. 'F' -> Some (Char.code c - Char.code 'A' + 10)
  | _ -> None

let decoded text =
  let length = String.length text in
  let b = Buffer.create length in
  let digit i = if i < length then digit text.[i] else None in
  let rec from i =
    if i = length then Some (Buffer.contents b)
    else if text.[i] <> '%' then (Buffer.add_char b text.[i]; from (i + 1))
    else
      match digit (i + 1), digit (i + 2) with
      | Some high, Some low -> Buffer.add_char b (Char.chr ((16 * high) + low)); from (i + 3)
      | _, _ -> None
  in
  from 0
