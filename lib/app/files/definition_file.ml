open Dolphin_syntax
module Imc_xml = Dolphin_imc_definition.Imc_xml

(* The offset of a line, in bytes. *)
let rec offset source ~line from =
  if line <= 1 then from
  else
    match String.index_from_opt source from '\n' with
    | Some newline -> offset source ~line:(line - 1) (newline + 1)
    | None -> from

let error path source ({ line; column; why } : Imc_xml.error) =
  if line = 0 then Error.Bad_input (Printf.sprintf "%s: %s" path why)
  else
    let bol = offset source ~line 0 in
    let at = { Lexing.pos_fname = path; pos_lnum = line; pos_bol = bol; pos_cnum = bol + max 0 (column - 1) } in
    Error.Bad_text { source; found = [ Diagnostic.error (Location.make (at, at)) why ] }

let read path source =
  match Imc_xml.parse source with
  | Error e -> Error (error path source e)
  | Ok definition -> (
      match Dolphin_platform_imc.Compatibility.differences definition with
      | [] -> Ok (Some definition)
      | differences -> Error (Error.Incompatible { path; differences }))

let load = function
  | None -> Ok None
  | Some path -> Result.bind (Text_file.read path) (read path)
