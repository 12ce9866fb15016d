module Scenario = Dolphin_scenario.Scenario

type t = { path : string option; source : string; scenario : Scenario.t }
type trouble = Unreadable of string | Wrong of { source : string; found : Dolphin_syntax.Diagnostic.t list }

let choose ~program = function
  | Some named -> Some named
  | None ->
    let beside = Scenario.beside program in
    if beside <> program && Sys.file_exists beside then Some beside else None

let load = function
  | None -> Ok { path = None; source = ""; scenario = Scenario.default }
  | Some path -> (
      match Text_file.read path with
      | Error why -> Error (Unreadable why)
      | Ok source -> (
          match Scenario.read ~file:path source with
          | Ok scenario -> Ok { path = Some path; source; scenario }
          | Error found -> Error (Wrong { source; found })))

let tell = function
  | Unreadable why -> Report.complain why
  | Wrong { source; found } -> Report.diagnostics ~source found

let nobody = { Scenario.vehicles = []; plans = []; answers = []; replies = [] }
