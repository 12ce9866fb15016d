let time seconds =
  let whole = int_of_float (Float.floor (Float.min seconds 1e12 +. 1e-6)) in
  let minutes = whole / 60 mod 60 and hours = whole / 3600 in
  if hours > 0 then Printf.sprintf "%d:%02d:%02d" hours minutes (whole mod 60)
  else Printf.sprintf "%d:%02d" minutes (whole mod 60)

let count n what = Printf.sprintf "%d %s%s" n what (if n = 1 then "" else "s")

let harmless text =
  Dolphin_syntax.Character.printable (String.map (fun c -> if c = '\t' then ' ' else c) text)

let one_line text = String.map (fun c -> if c = '\n' then ' ' else c) (harmless text)
let is_continuation c = Char.code c land 0xC0 = 0x80
let width text = String.fold_left (fun n c -> if is_continuation c then n else n + 1) 0 text
let pad n text = text ^ String.make (max 0 (n - width text)) ' '

let split n text =
  let length = String.length text in
  let rec stop i left =
    if i >= length then length
    else if is_continuation text.[i] then stop (i + 1) left
    else if left = 0 then i
    else stop (i + 1) (left - 1)
  in
  let i = stop 0 n in
  (String.sub text 0 i, String.sub text i (length - i))
