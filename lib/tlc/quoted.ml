let meaning = function
  | '"' -> Some '"'
  | '\\' -> Some '\\'
  | 'n' -> Some '\n'
  | 't' -> Some '\t'
  | 'r' -> Some '\r'
  | 'f' -> Some '\012'
  | _ -> None

let unescape s =
  let last = String.length s - 1 in
  let text = Buffer.create (String.length s) in
  let rec go i =
    if i = last then Some (Buffer.contents text)
    else
      match s.[i] with
      | '"' -> None
      | '\\' when i + 1 < last ->
        Option.bind (meaning s.[i + 1]) (fun c ->
            Buffer.add_char text c;
            go (i + 2))
      | '\\' -> None
      | c ->
        Buffer.add_char text c;
        go (i + 1)
  in
  if last < 1 || s.[0] <> '"' || s.[last] <> '"' then None else go 1
