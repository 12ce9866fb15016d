let scheme = "file://"

let decoded text =
  let length = String.length text in
  let buffer = Buffer.create length in
  let rec go i =
    if i < length then
      match if i + 2 < length && text.[i] = '%' then int_of_string_opt ("0x" ^ String.sub text (i + 1) 2) else None with
      | Some code ->
        Buffer.add_char buffer (Char.chr code);
        go (i + 3)
      | None ->
        Buffer.add_char buffer text.[i];
        go (i + 1)
  in
  go 0;
  Buffer.contents buffer

let to_path uri =
  let n = String.length scheme in
  if String.length uri >= n && String.sub uri 0 n = scheme then
    let rest = String.sub uri n (String.length uri - n) in
    (* A host, as in file://localhost/home. *)
    match String.index_opt rest '/' with
    | Some at -> decoded (String.sub rest at (String.length rest - at))
    | None -> decoded rest
  else uri

let of_path path =
  let plain = function
    | 'a' .. 'z' | 'A' .. 'Z' | '0' .. '9' | '/' | '-' | '_' | '.' | '~' -> true
    | _ -> false in
  let buffer = Buffer.create (String.length path + 16) in
  String.iter
    (fun c ->
       if plain c then Buffer.add_char buffer c
       else Buffer.add_string buffer (Printf.sprintf "%%%02X" (Char.code c)))
    path;
  scheme ^ Buffer.contents buffer
