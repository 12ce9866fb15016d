type t = { mutable is_closed : bool }

exception Closed

let create () = { is_closed = false }
let give t = if t.is_closed then raise_notrace Closed

let with_closed t now f =
  let before = t.is_closed in
  t.is_closed <- now;
  Fun.protect ~finally:(fun () -> t.is_closed <- before) f

let closed t f = with_closed t true f
let opened t f = with_closed t false f
