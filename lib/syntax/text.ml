(* The length of the well-formed UTF-8 character at [i], or 0. *)
let character source i =
  let length = String.length source in
  let byte k = if i + k < length then Char.code source.[i + k] else 0 in
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

let fault ~file source =
  let rec first_fault i =
    if i >= String.length source then None
    else
      match character source i with
      | 0 -> Some i
      | n -> first_fault (i + n)
  in
  let tell i =
    let cursor = Cursor.make ~file source in
    let start = Cursor.position cursor i in
    let at = Location.make (start, Cursor.position cursor (i + 1)) in
    let message =
      if source.[i] = '\000' then "this file is not text: a zero byte stands here"
      else Printf.sprintf "this file is not UTF-8 text: byte 0x%02X stands here" (Char.code source.[i]) in
    Diagnostic.error at message ~hint:"save the program as UTF-8 text"
  in
  Option.map tell (first_fault 0)
