open Dolphin_semantics

type item = { key : string; value : Core.value; told : bool Lwt.u }
type t = {
  items : item Lwt_stream.t;
  push : item option -> unit;
  mutable closed : bool;
  mutable questions : string list;
}

let create () =
  let items, push = Lwt_stream.create () in
  { items; push; closed = false; questions = [] }

let post t key value =
  if t.closed then Lwt.return_false
  else begin
    let taken, told = Lwt.wait () in
    t.push (Some { key; value; told });
    taken
  end

let questions t = t.questions
let is_closed t = t.closed
let ask t questions = t.questions <- questions
let next t = Lwt_stream.next t.items
let tell item taken = Lwt.wakeup_later item.told taken

let close t =
  t.closed <- true;
  List.iter (fun item -> tell item false) (Lwt_stream.get_available t.items)
