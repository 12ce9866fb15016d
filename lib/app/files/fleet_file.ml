module Scenario = Dolphin_scenario.Scenario
module Charts = Dolphin_charts.Charts
module Location = Dolphin_syntax.Location

type t = {
  path : string option;
  source : string;
  scenario : Scenario.t;
  warnings : Dolphin_syntax.Diagnostic.t list;
}

let choose ~program = function
  | Some named -> Some named
  | None ->
    let beside = Scenario.beside program in
    if beside <> program && Sys.file_exists beside then Some beside else None

(* They are shown beside those of a program, whose text is another: so without the line that they point at. *)
let map_warnings charts ast =
  let module Chart_calls = Dolphin_semantics.Chart_calls in
  let without_line at (d : Dolphin_syntax.Diagnostic.t) =
    { d with at = Location.none; message = Format.asprintf "%a: %s" Location.pp at d.message } in
  let of_call (path, at) =
    match Charts.value charts path with
    | Ok chart -> List.map (without_line at) (Chart_calls.warnings at path chart)
    | Error _ -> []
  in
  List.concat_map of_call (Chart_calls.paths ast)

(* Maps are part of a fleet, as of programs. *)
let read ~may_read path source =
  let ast = Result.value (Dolphin_syntax.Parse.program ~file:path source) ~default:[] in
  let charts = Charts.read (Text_file.read_named ~may_read) ast in
  match Scenario.read ~chart:(Charts.value charts) ~file:path source with
  | Ok scenario ->
    Ok { path = Some path; source = source ^ Charts.identity charts; scenario; warnings = map_warnings charts ast }
  | Error found -> Error (Error.Bad_text { source; found })

let load ?(may_read = Text_file.anything) = function
  | None -> Ok { path = None; source = ""; scenario = Scenario.default; warnings = [] }
  | Some path -> Result.bind (Text_file.read path) (read ~may_read path)

let load_for ~program named = load (choose ~program named)

let nobody =
  { path = None; source = ""; warnings = [];
    scenario =
      { vehicles = []; plans = []; answers = []; replies = []; inputs = []; samples = []; fences = [];
        plans_at = None; recurrences = []; begins = None; zone = None } }

let beginning begins f = { f with scenario = { f.scenario with begins } }
let header f = Option.map (fun path -> Dolphin_trace.Header.source ~path f.source) f.path
