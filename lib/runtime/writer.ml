open Lwt.Infix

let write output text =
  let rec from start =
    if start = String.length text then Lwt.return_unit
    else Lwt_unix.write_string output text start (String.length text - start) >>= fun n -> from (start + n)
  in
  from 0

type t = {
  output : Lwt_unix.file_descr;
  unwritten : Buffer.t;
  mutable writing : unit Lwt.t;
}

let make output = { output; unwritten = Buffer.create 4096; writing = Lwt.return_unit }

let rec flush w =
  if Buffer.length w.unwritten = 0 then Lwt.return_unit
  else begin
    let text = Buffer.contents w.unwritten in
    Buffer.clear w.unwritten;
    Lwt.catch
      (fun () -> write w.output text)
      (function Unix.Unix_error _ -> Lwt.return_unit | error -> Lwt.fail error)
    >>= fun () -> flush w
  end

let send w text =
  Buffer.add_string w.unwritten text;
  match Lwt.state w.writing with
  | Sleep -> ()
  | Return () | Fail _ ->
    w.writing <- flush w;
    Lwt.async (fun () -> w.writing)

let sent w = w.writing
