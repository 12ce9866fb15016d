let clock seconds =
  let whole = int_of_float (Float.floor (seconds +. 1e-6)) in
  let minutes = whole / 60 mod 60 and hours = whole / 3600 in
  if hours > 0 then Printf.sprintf "%d:%02d:%02d" hours minutes (whole mod 60)
  else Printf.sprintf "%d:%02d" minutes (whole mod 60)

(* In one unit, if six digits are enough for that: 1.5 min; else in several: 20 min 34.56 s. *)
let rec duration seconds =
  let unit, name = if seconds >= 3600. then (3600., "h") else if seconds >= 60. then (60., "min") else (1., "s") in
  let short = Printf.sprintf "%g" (seconds /. unit) in
  if unit = 1. || float_of_string short *. unit = seconds || not (Float.is_finite seconds) then short ^ " " ^ name
  else
    let whole = Float.floor (seconds /. unit) in
    Printf.sprintf "%.0f %s %s" whole name (duration (seconds -. (whole *. unit)))

let most_named = 8

let vehicles vs =
  let n = List.length vs in
  if n <= most_named then String.concat ", " vs
  else
    let named = List.filteri (fun i _ -> i < most_named) vs in
    Printf.sprintf "%s and %d more" (String.concat ", " named) (n - most_named)

(* A terminal may take the characters from U+0080 to U+009F, C2 80 to C2 9F in UTF-8, for commands too. *)
let harmless text =
  let is_control i c =
    (Char.code c < 0x20 && c <> '\n') || c = '\x7F'
    || Char.code c land 0xE0 = 0x80 && i > 0 && text.[i - 1] = '\xC2'
  in
  String.mapi (fun i c -> if c = '\t' then ' ' else if is_control i c then '?' else c) text

let width text =
  let is_continuation c = Char.code c land 0xC0 = 0x80 in
  String.fold_left (fun n c -> if is_continuation c then n else n + 1) 0 text

let pad n text = text ^ String.make (max 0 (n - width text)) ' '
