open Cmdliner
open Dolphin_syntax
module Imc_xml = Dolphin_imc_definition.Imc_xml

let file =
  let doc =
    "Take names that Dolphin has not got, and messages that it does not know, from the definition of IMC in $(docv), \
     as vehicles come with it: $(i,IMC.xml). It is an error if Dolphin's messages differ from it."
  in
  Arg.(value & opt (some string) None & info [ "imc-xml" ] ~docs:"IMC NETWORK" ~docv:"FILE" ~doc)

(* Where a line begins, in bytes. *)
let rec offset source ~line from =
  if line <= 1 then from
  else
    match String.index_from_opt source from '\n' with
    | Some newline -> offset source ~line:(line - 1) (newline + 1)
    | None -> from

let tell path source ({ line; column; why } : Imc_xml.error) =
  if line = 0 then Report.complain (Printf.sprintf "%s: %s" path why)
  else
    let bol = offset source ~line 0 in
    let at = { Lexing.pos_fname = path; pos_lnum = line; pos_bol = bol; pos_cnum = bol + max 0 (column - 1) } in
    Report.diagnostics ~source [ Diagnostic.error (Location.make (at, at)) why ]

let disagree path differences =
  let speaks why = Report.complain (Printf.sprintf "%s is not the IMC that Dolphin speaks: %s" path why) in
  List.iter speaks differences

let load = function
  | None -> Ok None
  | Some path -> (
      match Text_file.read path with
      | Error why -> Report.complain why; Error Exit_status.Bad_input
      | Ok source -> (
          match Imc_xml.parse source with
          | Error error -> tell path source error; Error Exit_status.Bad_input
          | Ok definition -> (
              match Dolphin_platform_imc.Compatibility.differences definition with
              | [] -> Ok (Some definition)
              | differences -> disagree path differences; Error Exit_status.Bad_input)))
