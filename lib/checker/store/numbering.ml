exception Closed

let is_closed = ref false
let give () = if !is_closed then raise_notrace Closed

let with_closed now f =
  let before = !is_closed in
  is_closed := now;
  Fun.protect ~finally:(fun () -> is_closed := before) f

let closed f = with_closed true f
let opened f = with_closed false f
