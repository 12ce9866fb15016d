open Dolphin_conformance

(* No request is longer. *)
let longest = 64 * 1024 * 1024

type line = Line of string | Too_long | End

let rec skip_line channel =
  match input_char channel with '\n' -> () | _ -> skip_line channel | exception End_of_file -> ()

let read_line channel =
  let line = Buffer.create 1024 in
  let rec go () =
    match input_char channel with
    | '\n' -> Line (Buffer.contents line)
    | exception End_of_file -> if Buffer.length line = 0 then End else Line (Buffer.contents line)
    | _ when Buffer.length line >= longest -> skip_line channel; Too_long
    | c -> Buffer.add_char line c; go ()
  in
  go ()

let too_long = {|{"error":{"code":"bad-request","message":"a request is at most 64 MB long"}}|}
let is_blank line = String.trim line = ""

let serve_as start input output =
  let reply text =
    output_string output text;
    output_char output '\n';
    flush output
  in
  let rec go oracle =
    match read_line input with
    | End -> ()
    | Too_long -> reply too_long; go oracle
    | Line line when is_blank line -> go oracle
    | Line line ->
      let oracle, answer = Oracle.answer_line oracle line in
      reply answer;
      go oracle
  in
  go start

let serve ~name input output = serve_as (Oracle.start ~name) input output
