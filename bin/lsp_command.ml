open Cmdliner
module Server = Dolphin_lsp.Language_server

(* A header, up to its empty line; its length. [None] at the end of the input. *)
let rec header length =
  match input_line stdin with
  | exception End_of_file -> None
  | line ->
    match String.trim line with
    | "" -> Some length
    | line ->
      match String.index_opt line ':' with
      | Some at when String.lowercase_ascii (String.sub line 0 at) = "content-length" ->
        header (int_of_string_opt (String.trim (String.sub line (at + 1) (String.length line - at - 1))))
      | Some _ | None -> header length

let send message =
  let text = Dolphin_json.Canonical.to_string message in
  Printf.printf "Content-Length: %d\r\n\r\n%s%!" (String.length text) text

(* No message is larger: a larger number is not a header. *)
let most_bytes = 256 * 1024 * 1024

let rec serve server =
  match header None with
  | None ->
    Report.complain "the input ended without the notification 'exit'";
    Exit_status.Bad_input
  | Some (Some length) when length >= 0 && length <= most_bytes ->
    (match really_input_string stdin length with
     | exception End_of_file ->
       Report.complain "the input ended amid a message";
       Exit_status.Bad_input
     | text -> take server text)
  | Some (Some _ | None) ->
    Report.complain "a message begins with Content-Length: BYTES, and an empty line";
    Exit_status.Bad_input

and take server text =
  match Dolphin_json.Host_value.parse text with
  | Error _ ->
    send Server.not_json;
    serve server
  | Ok message ->
    let server, messages = Server.handle server message in
    List.iter send messages;
    match Server.ended server with
    | Some 0 -> Exit_status.Done
    | Some _ -> Exit_status.Failed
    | None -> serve server

let run () =
  set_binary_mode_in stdin true;
  set_binary_mode_out stdout true;
  let read path = Result.to_option (Dolphin_app.Text_file.read path) in
  serve (Server.make ~version:Version.number ~read)

let man =
  [ `S Manpage.s_description;
    `P "$(tname) is a language server for editors: it speaks the Language Server Protocol on its standard input and \
        output. It reports faults as $(b,check) does, completes names, settings, maneuvers and plans of the fleet, \
        describes names, finds definitions and uses, renames, and formats as $(b,fmt) does.";
    `P "$(i,docs/editors.md) describes how to set up editors.";
    `S Manpage.s_files;
    `I ("$(i,PROG) with the ending $(b,.fleet)", "The fleet of a program that is being edited.") ]
  @ Options.see_also

let exits =
  Cmd.Exit.info (Exit_status.code Failed) ~doc:"the client ended the server without $(b,shutdown)."
  :: Options.exits [ Done; Bad_input; Platform_trouble; Bug ]

let stdio =
  let doc = "Accepted for clients that pass it: standard input and output are used in any case." in
  Arg.(value & flag & info [ "stdio" ] ~doc)

let command =
  let info = Cmd.info "lsp" ~docs:Options.s_write ~doc:"help an editor: a language server" ~man ~exits in
  Cmd.v info Term.(const (fun _ -> run ()) $ stdio)
