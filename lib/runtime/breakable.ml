exception Broken of (unit -> unit)

type t = { mutable is_running : bool }

let make () = { is_running = false }

let attempt b f =
  match
    b.is_running <- true;
    let x = f () in
    b.is_running <- false;
    x
  with
  | x -> Some x
  | exception Broken request -> request (); None
  | exception error ->
    b.is_running <- false;
    raise error

let break b request =
  if b.is_running then begin
    b.is_running <- false;
    raise_notrace (Broken request)
  end
