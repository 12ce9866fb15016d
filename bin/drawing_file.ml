open Cmdliner
open Dolphin_trace

type kind = Svg | Html
type t = { path : string; kind : kind }

let argument =
  let parse path =
    match String.lowercase_ascii (Filename.extension path) with
    | ".svg" -> Ok { path; kind = Svg }
    | ".html" | ".htm" -> Ok { path; kind = Html }
    | _ -> Error (`Msg (Printf.sprintf "'%s' ends neither in .svg nor in .html" path))
  in
  Arg.conv ~docv:"FILE" (parse, fun ppf d -> Format.pp_print_string ppf d.path)

let path d = d.path

let trouble why = Error ("the picture cannot be written: " ^ why)

let check d =
  let writable path rights =
    match Unix.access path rights with
    | () -> Ok ()
    | exception Unix.Unix_error (error, _, _) -> trouble (Printf.sprintf "%s: %s" d.path (Unix.error_message error))
  in
  match Sys.is_directory d.path with
  | true -> trouble (d.path ^ ": this is a directory, not a file")
  | false -> writable d.path [ W_OK ]
  | exception Sys_error _ -> writable (Filename.dirname d.path) [ W_OK; X_OK ]

let write d story =
  let text = match d.kind with Svg -> Picture.svg story | Html -> Picture.html story in
  let save () =
    let channel = open_out_bin d.path in
    Fun.protect
      ~finally:(fun () -> close_out_noerr channel)
      (fun () ->
         output_string channel text;
         close_out channel)
  in
  match save () with () -> Ok () | exception Sys_error why -> trouble why
