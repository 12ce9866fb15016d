type t = { holder : string option; asking : string list }

let equal a b = Option.equal String.equal a.holder b.holder && List.equal String.equal a.asking b.asking
let free = { holder = None; asking = [] }
let holder h = h.holder
let asking h = h.asking

let command h client =
  match h.holder with
  | None -> Ok { holder = Some client; asking = List.filter (( <> ) client) h.asking }
  | Some holder when holder = client -> Ok h
  | Some _ -> Error "another page has the helm: this one watches, and may ask for it"

let most_asking = 10

let ask h client =
  match h.holder with
  | None -> { holder = Some client; asking = List.filter (( <> ) client) h.asking }
  | Some holder when holder = client || List.mem client h.asking || List.length h.asking >= most_asking -> h
  | Some _ -> { h with asking = h.asking @ [ client ] }

let give_up h client =
  let asking = List.filter (( <> ) client) h.asking in
  if h.holder <> Some client then { h with asking }
  else match asking with [] -> free | first :: others -> { holder = Some first; asking = others }

let is_name text =
  let is_good c =
    match c with 'a' .. 'z' | 'A' .. 'Z' | '0' .. '9' | '.' | '-' | '_' -> true | _ -> false in
  let n = String.length text in
  n > 0 && n <= 64 && Seq.fold_left (fun all c -> all && is_good c) true (String.to_seq text)
