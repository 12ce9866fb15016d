type t = {
  directory : string;
  file : Unix.file_descr;
  buffer : Bytes.t;  (* still to be written *)
  mutable filled : int;  (* bytes of it *)
  mutable written : int;  (* bytes of the file *)
}

exception Failed of string

let fail directory error = raise (Failed (Printf.sprintf "%s: %s" directory (Unix.error_message error)))

let create ~directory =
  match
    let path = Filename.temp_file ~temp_dir:directory "dolphin" ".states" in
    let file = Unix.openfile path [ O_RDWR; O_CLOEXEC ] 0o600 in
    Unix.unlink path;
    file
  with
  | file -> { directory; file; buffer = Bytes.create 65_536; filled = 0; written = 0 }
  | exception Unix.Unix_error (error, _, _) -> fail directory error
  | exception Sys_error _ -> raise (Failed (directory ^ ": no file can be made there"))

let rec whole f operation at upto =
  if at < upto then
    match operation at (upto - at) with
    | 0 -> raise (Failed (f.directory ^ ": the file of states has become shorter"))
    | n -> whole f operation (at + n) upto
    | exception Unix.Unix_error (EINTR, _, _) -> whole f operation at upto
    | exception Unix.Unix_error (error, _, _) -> fail f.directory error

let seek f at =
  match Unix.LargeFile.lseek f.file (Int64.of_int at) SEEK_SET with
  | (_ : int64) -> ()
  | exception Unix.Unix_error (error, _, _) -> fail f.directory error

let write f =
  seek f f.written;
  whole f (Unix.write f.file f.buffer) 0 f.filled;
  f.written <- f.written + f.filled;
  f.filled <- 0

let append f x =
  if f.filled = Bytes.length f.buffer then write f;
  Bytes.set_int64_le f.buffer f.filled (Int64.of_int x);
  f.filled <- f.filled + 8

let read f ~at bytes ~words =
  if 8 * (at + words) > f.written then write f;
  seek f (8 * at);
  whole f (Unix.read f.file bytes) 0 (8 * words)

let close f = try Unix.close f.file with Unix.Unix_error _ -> ()
