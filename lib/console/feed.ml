type t = { run : string; fd : Unix.file_descr; mutable length : int; mutable closed : bool }

let create ~run =
  let path = Filename.temp_file "dolphin-console" ".events" in
  let fd = Unix.openfile path [ O_RDWR; O_CLOEXEC ] 0o600 in
  Unix.unlink path;
  { run; fd; length = 0; closed = false }

let rec write fd text start =
  if start < String.length text then
    write fd text (start + Unix.write_substring fd text start (String.length text - start))

(* An identity is the run and where the message ends, in digits of a fixed number. *)
let digits = 13

let add f ~event data =
  if not f.closed then begin
    let text offset = Printf.sprintf "id: %s/%0*d\nevent: %s\ndata: %s\n\n" f.run digits offset event data in
    let text = text (f.length + String.length (text 0)) in
    ignore (Unix.lseek f.fd f.length SEEK_SET);
    write f.fd text 0;
    f.length <- f.length + String.length text
  end

let rec end_of_messages buffer n =
  match Bytes.rindex_from_opt buffer (n - 1) '\n' with
  | Some last when last > 0 && Bytes.get buffer (last - 1) = '\n' -> Some (last + 1)
  | Some last when last > 0 -> end_of_messages buffer last
  | Some _ | None -> None

let rec read_piece f offset size =
  let size = min size (f.length - offset) in
  if f.closed || size <= 0 then ("", offset)
  else begin
    let buffer = Bytes.create size in
    ignore (Unix.lseek f.fd offset SEEK_SET);
    let n = Unix.read f.fd buffer 0 size in
    match if n = 0 then Some 0 else end_of_messages buffer n with
    | Some stop -> (Bytes.sub_string buffer 0 stop, offset + stop)
    | None -> read_piece f offset (2 * size)
  end

let read f offset = read_piece f offset 65_536

let resumed f id =
  match String.split_on_char '/' id with
  | [ run; offset ] when run = f.run && String.length offset = digits -> (
      match int_of_string_opt ("0u" ^ offset) with
      | Some offset when offset >= 0 && offset <= f.length -> offset
      | Some _ | None -> 0)
  | _ -> 0

let close f =
  if not f.closed then begin
    f.closed <- true;
    Unix.close f.fd
  end
