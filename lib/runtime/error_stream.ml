open Lwt.Infix
module Utf8 = Dolphin_utf8.Utf8

(* Bytes that wait for standard error. *)
let most_waiting = 16 * 1024 * 1024

(* Bytes of a line without an end that wait for its end. *)
let longest = 16 * 1024

type t = {
  line : Buffer.t;  (* without its end yet *)
  waiting : Buffer.t;  (* to be written *)
  mutable dropped : int;  (* bytes *)
  mutable writing : unit Lwt.t;
}

(* {1 Writing} *)

(* If standard error is closed, the errors have no reader. *)
let rec write_waiting e =
  if e.dropped > 0 && Buffer.length e.waiting = 0 then begin
    Buffer.add_string e.waiting (Printf.sprintf "... (%d bytes are left out)\n" e.dropped);
    e.dropped <- 0
  end;
  if Buffer.length e.waiting = 0 then Lwt.return_unit
  else begin
    let text = Buffer.contents e.waiting in
    Buffer.clear e.waiting;
    Lwt.catch
      (fun () -> Writer.write Lwt_unix.stderr text)
      (function Unix.Unix_error _ -> Lwt.return_unit | error -> Lwt.fail error)
    >>= fun () -> write_waiting e
  end

let write e text =
  let text = Dolphin_trace.Phrase.harmless text in
  if Buffer.length e.waiting + String.length text > most_waiting then e.dropped <- e.dropped + String.length text
  else Buffer.add_string e.waiting text;
  match Lwt.state e.writing with
  | Sleep -> ()
  | Return () | Fail _ -> e.writing <- write_waiting e

(* {1 Reading} *)

(* The length of [text] without a character that may go on after its end. *)
let whole text =
  let length = String.length text in
  let is_begun i = Char.code text.[i] >= 0xC0 && Utf8.length text i = 0 in
  let rec from i = if i < max 0 (length - 3) then length else if is_begun i then i else from (i - 1) in
  from (length - 1)

let add e bytes length =
  let one i =
    match Bytes.get bytes i with
    | '\r' when i + 1 < length && Bytes.get bytes (i + 1) = '\n' -> ()
    | '\r' | '\n' ->
      Buffer.add_char e.line '\n';
      write e (Buffer.contents e.line);
      Buffer.clear e.line
    | c -> Buffer.add_char e.line c
  in
  for i = 0 to length - 1 do one i done;
  if Buffer.length e.line > longest then begin
    let text = Buffer.contents e.line in
    let n = whole text in
    write e (String.sub text 0 n);
    Buffer.clear e.line;
    Buffer.add_string e.line (String.sub text n (String.length text - n))
  end

let pass_on input =
  let e = { line = Buffer.create 256; waiting = Buffer.create 256; dropped = 0; writing = Lwt.return_unit } in
  let chunk = Bytes.create 4096 in
  let read () =
    Lwt.catch
      (fun () -> Lwt_unix.read input chunk 0 (Bytes.length chunk))
      (function Unix.Unix_error _ -> Lwt.return 0 | error -> Lwt.fail error)
  in
  let rec go () =
    read () >>= function
    | 0 ->
      if Buffer.length e.line > 0 then write e (Buffer.contents e.line ^ "\n");
      e.writing >>= fun () ->
      Lwt.catch (fun () -> Lwt_unix.close input) (fun _ -> Lwt.return_unit)
    | length -> add e chunk length; go ()
  in
  go ()
