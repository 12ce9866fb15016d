let character = Character.length

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
