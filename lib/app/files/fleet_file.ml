module Scenario = Dolphin_scenario.Scenario
module Charts = Dolphin_charts.Charts

type t = { path : string option; source : string; scenario : Scenario.t }

let choose ~program = function
  | Some named -> Some named
  | None ->
    let beside = Scenario.beside program in
    if beside <> program && Sys.file_exists beside then Some beside else None

(* Maps are part of a fleet, as of programs. *)
let read ~may_read path source =
  let ast = Result.value (Dolphin_syntax.Parse.program ~file:path source) ~default:[] in
  let charts = Charts.read (Text_file.read_named ~may_read) ast in
  match Scenario.read ~chart:(Charts.value charts) ~file:path source with
  | Ok scenario -> Ok { path = Some path; source = source ^ Charts.identity charts; scenario }
  | Error found -> Error (Error.Bad_text { source; found })

let load ?(may_read = Text_file.anything) = function
  | None -> Ok { path = None; source = ""; scenario = Scenario.default }
  | Some path -> Result.bind (Text_file.read path) (read ~may_read path)

let load_for ~program named = load (choose ~program named)

let nobody =
  { path = None; source = "";
    scenario = { vehicles = []; plans = []; answers = []; replies = []; inputs = []; samples = []; fences = [] } }
let header f = Option.map (fun path -> Dolphin_trace.Header.source ~path f.source) f.path
