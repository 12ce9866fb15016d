open Dolphin_syntax

type t = {
  path : string;
  source : string;
  program : Dolphin_semantics.Core.program;
  warnings : Diagnostic.t list;
}

type trouble = Unreadable of string | Wrong of { source : string; found : Diagnostic.t list }

let ( let* ) = Result.bind
let read path = Result.map_error (fun why -> Unreadable why) (Text_file.read path)
let wrong source result = Result.map_error (fun found -> Wrong { source; found }) result

let parse path =
  let* source = read path in
  wrong source (Parse.program ~file:path source)

let no_fleet path =
  if Filename.extension path <> ".fleet" then Ok ()
  else Error (Unreadable (Printf.sprintf "%s: this is a fleet: name a program, and the fleet by --fleet %s" path path))

let load path =
  let* source = read path in
  let* () = no_fleet path in
  let* ast = wrong source (Parse.program ~file:path source) in
  let* program, warnings = wrong source (Dolphin_semantics.Elaborate.program ~source_name:path ast) in
  Ok { path; source; program; warnings }

let tell = function
  | Unreadable why -> Report.complain why
  | Wrong { source; found } -> Report.diagnostics ~source found
