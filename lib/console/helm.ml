type t = { holder : string option; asking : string list; taken_from : string option }

let equal a b =
  Option.equal String.equal a.holder b.holder
  && List.equal String.equal a.asking b.asking
  && Option.equal String.equal a.taken_from b.taken_from

let free = { holder = None; asking = []; taken_from = None }
let holder h = h.holder
let asking h = h.asking
let taken_from h = h.taken_from

let given ?taken_from h client =
  { holder = Some client; asking = List.filter (( <> ) client) h.asking; taken_from }

let command h client =
  match h.holder with
  | None -> Ok (given h client)
  | Some holder when holder = client -> Ok h
  | Some _ -> Error "another page has the helm: this one watches, and may ask for it or take it"

let most_asking = 10

let ask h client =
  match h.holder with
  | None -> given h client
  | Some holder when holder = client || List.mem client h.asking || List.length h.asking >= most_asking -> h
  | Some _ -> { h with asking = h.asking @ [ client ] }

let force h client =
  match h.holder with
  | Some holder when holder = client -> h
  | holder -> given ?taken_from:holder h client

let give_up h client =
  let asking = List.filter (( <> ) client) h.asking in
  if h.holder <> Some client then { h with asking }
  else match asking with [] -> free | first :: others -> { holder = Some first; asking = others; taken_from = None }
