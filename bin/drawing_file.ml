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
  match save () with () -> Ok () | exception Sys_error why -> Error ("the picture cannot be written: " ^ why)
