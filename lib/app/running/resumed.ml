open Dolphin_runtime
open Dolphin_trace

type t = { path : string; past : Resumption.t; summary : Summary.builder }

let read_channel ~changed ~tell (program : Program_file.t) path channel =
  let summary = Summary.create () in
  let tell entry replay =
    Summary.add summary entry;
    tell entry replay
  in
  let { Header.hash; path = _ } = Program_file.header program in
  match Resumption.read ~tell ~changed program.program ~hash (Journal.of_channel channel) with
  | Ok past -> Ok { path; past; summary }
  | Error trouble -> Error (Error.Bad_input (Format.asprintf "@[<v 2>%s: %a@]" path Resumption.pp_trouble trouble))

let read ~changed ~tell program path = Text_file.with_channel path (read_channel ~changed ~tell program path)

let fleet r ~named =
  let header = r.past.header in
  let hash (s : Header.source) = s.hash in
  let same (fleet : Fleet_file.t) =
    if Option.map hash (Fleet_file.header fleet) = Option.map hash header.fleet then Ok fleet
    else
      let path = Option.value fleet.path ~default:"the built-in fleet" in
      Error (Error.Bad_input (path ^ ": this is not the fleet that the run was on, or it has changed since"))
  in
  let path = match named with Some _ -> named | None -> Option.map (fun (s : Header.source) -> s.path) header.fleet in
  Result.bind (Fleet_file.load path) same
