module Scenario = Dolphin_scenario.Scenario

type t = { path : string option; source : string; scenario : Scenario.t }

let choose ~program = function
  | Some named -> Some named
  | None ->
    let beside = Scenario.beside program in
    if beside <> program && Sys.file_exists beside then Some beside else None

let read path source =
  match Scenario.read ~file:path source with
  | Ok scenario -> Ok { path = Some path; source; scenario }
  | Error found -> Error (Error.Bad_text { source; found })

let load = function
  | None -> Ok { path = None; source = ""; scenario = Scenario.default }
  | Some path -> Result.bind (Text_file.read path) (read path)

let load_for ~program named = load (choose ~program named)

let nobody =
  { path = None; source = "";
    scenario = { vehicles = []; plans = []; answers = []; replies = []; inputs = []; samples = [] } }
let header f = Option.map (fun path -> Dolphin_trace.Header.source ~path f.source) f.path
