type t = {
  file : string;
  source : string;
  mutable offset : int;
  mutable line : int;
  mutable beginning : int;  (* offset of the line's start, plus the bytes so far that begin no character *)
}

let make ~file source = { file; source; offset = 0; line = 1; beginning = 0 }

let position cursor offset =
  for i = cursor.offset to offset - 1 do
    match String.unsafe_get cursor.source i with
    | '\n' ->
      cursor.line <- cursor.line + 1;
      cursor.beginning <- i + 1
    | '\x80' .. '\xBF' -> cursor.beginning <- cursor.beginning + 1
    | _ -> ()
  done;
  cursor.offset <- max cursor.offset offset;
  { Lexing.pos_fname = cursor.file; pos_lnum = cursor.line; pos_bol = cursor.beginning; pos_cnum = offset }
