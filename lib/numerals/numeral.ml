let is_digit c = '0' <= c && c <= '9'
let is_hexadecimal c = is_digit c || ('a' <= c && c <= 'f') || ('A' <= c && c <= 'F')

(* The end of the characters from [i] on that are all [wanted]. *)
let rec span wanted text i = if i < String.length text && wanted text.[i] then span wanted text (i + 1) else i

let has text i c = i < String.length text && text.[i] = c
let behind_sign text i = if has text i '-' || has text i '+' then i + 1 else i

let is_decimal text =
  let start = behind_sign text 0 in
  let point = span is_digit text start in
  let mantissa = if has text point '.' then span is_digit text (point + 1) else point in
  let digits = mantissa - start - if mantissa > point then 1 else 0 in
  let power_from = behind_sign text (mantissa + 1) in
  let power = span is_digit text power_from in
  digits > 0
  && (mantissa = String.length text
      || ((has text mantissa 'e' || has text mantissa 'E') && power > power_from && power = String.length text))

let number text =
  if not (is_decimal text) then None
  else match float_of_string_opt text with Some x when Float.is_finite x -> Some x | Some _ | None -> None

let whole text =
  let start = behind_sign text 0 in
  let length = String.length text in
  if start = length || span is_digit text start < length then None
  else int_of_string_opt (if has text 0 '+' then String.sub text 1 (length - 1) else text)

let whole_or_hexadecimal text =
  let length = String.length text in
  if length > 2 && has text 0 '0' && (has text 1 'x' || has text 1 'X') && span is_hexadecimal text 2 = length then
    match int_of_string_opt text with Some n when n >= 0 -> Some n | Some _ | None -> None
  else whole text
