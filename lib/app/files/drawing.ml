open Dolphin_trace

type kind = Svg | Html
type t = { path : string; kind : kind; layers : Layer.t list }

let of_path path =
  match String.lowercase_ascii (Filename.extension path) with
  | ".svg" -> Ok { path; kind = Svg; layers = [] }
  | ".html" | ".htm" -> Ok { path; kind = Html; layers = [] }
  | _ -> Error (Printf.sprintf "'%s' ends neither in .svg nor in .html" path)

let over layers d = { d with layers }
let path d = d.path

(* Failures are the picture's. *)
let trouble e = Error.Unavailable (Format.asprintf "the picture cannot be written: %a" Error.pp e)
let check d = Result.map_error trouble (Text_file.check d.path)

let write_text d ~svg ~html =
  let text = match d.kind with Svg -> svg () | Html -> html () in
  Result.map_error trouble (Text_file.write d.path (fun channel -> output_string channel text))

let write d run =
  let run = { run with Summary.layers = d.layers } in
  write_text d ~svg:(fun () -> Picture.svg run) ~html:(fun () -> Picture.html run)
