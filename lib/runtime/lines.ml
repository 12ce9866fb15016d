open Lwt.Infix

type t = {
  input : Lwt_unix.file_descr;
  limit : int;
  chunk : Bytes.t;  (* the last bytes read; those from [first] up to [last] are not yet used *)
  mutable first : int;
  mutable last : int;
  line : Buffer.t;  (* the line so far *)
  mutable skipping : bool;  (* this line was reported as too long, its rest is dropped *)
}

type line = Line of string | Too_long | End_of_input

let make ~limit input =
  { input; limit; chunk = Bytes.create 4096; first = 0; last = 0; line = Buffer.create 256; skipping = false }

let line_end t =
  match Bytes.index_from_opt t.chunk t.first '\n' with
  | Some i when i < t.last -> Some i
  | Some _ | None -> None

let take_line t =
  let text = Buffer.contents t.line in
  Buffer.clear t.line;
  let length = String.length text in
  if length > 0 && text.[length - 1] = '\r' then String.sub text 0 (length - 1) else text

(* Moves bytes up to [stop] from the chunk to the line. *)
let consume t stop =
  if not t.skipping then Buffer.add_subbytes t.line t.chunk t.first (stop - t.first);
  t.first <- stop

let read t =
  Lwt.catch
    (fun () -> Lwt_unix.read t.input t.chunk 0 (Bytes.length t.chunk))
    (function Unix.Unix_error _ -> Lwt.return 0 | other -> Lwt.fail other)

let rec next t =
  match line_end t with
  | Some stop ->
    consume t stop;
    t.first <- stop + 1;
    if t.skipping then begin
      t.skipping <- false;
      next t
    end
    else if Buffer.length t.line > t.limit then begin
      Buffer.clear t.line;
      Lwt.return Too_long
    end
    else Lwt.return (Line (take_line t))
  | None ->
    consume t t.last;
    if Buffer.length t.line > t.limit then begin
      Buffer.clear t.line;
      t.skipping <- true;
      Lwt.return Too_long
    end
    else
      read t >>= fun length ->
      t.first <- 0;
      t.last <- length;
      if length > 0 then next t
      else if Buffer.length t.line > 0 then Lwt.return (Line (take_line t))
      else Lwt.return End_of_input
