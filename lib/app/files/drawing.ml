open Dolphin_trace

type kind = Svg | Html
type t = { path : string; kind : kind }

let of_path path =
  match String.lowercase_ascii (Filename.extension path) with
  | ".svg" -> Ok { path; kind = Svg }
  | ".html" | ".htm" -> Ok { path; kind = Html }
  | _ -> Error (Printf.sprintf "'%s' ends neither in .svg nor in .html" path)

let path d = d.path
let trouble why = Error (Error.Unavailable ("the picture cannot be written: " ^ why))

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

let write_text d ~svg ~html =
  let text = match d.kind with Svg -> svg () | Html -> html () in
  match Text_file.write d.path (fun channel -> output_string channel text) with
  | Ok () -> Ok ()
  | Error e -> trouble (Format.asprintf "%a" Error.pp e)

let write d run = write_text d ~svg:(fun () -> Picture.svg run) ~html:(fun () -> Picture.html run)
