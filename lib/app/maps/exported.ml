open Dolphin_geo
open Dolphin_plans
open Dolphin_trace
module Feature = Dolphin_maps.Feature
module Map_text = Dolphin_maps.Map_text

type t = {
  title : string;
  until : float;
  features : Feature.t list;
  columns : string list;
  rows : Feature.property list list;
  messages : Dolphin_maps.Mcap_file.message list Lazy.t;
}

let coordinates (p : Position.t) : Feature.property list =
  let rounded digits x : Feature.property = Number (Map_text.rounded digits x) in
  [ rounded 8 p.latitude; rounded 8 p.longitude; rounded 3 p.height ]

(* {1 Runs} *)

let ending : Summary.ending -> string = function
  | Done -> "done"
  | Failed why -> "failed: " ^ why
  | Stopped -> "stopped"
  | Unfinished -> "not ended"

let track ~started (v : Summary.vehicle) : Feature.t option =
  let sample (s : Summary.sample) : Feature.sample = { time = started +. s.time; position = s.position } in
  match v.samples with
  | [] -> None
  | first :: _ ->
    let last = List.fold_left (fun _ s -> s) first v.samples in
    let at (s : Summary.sample) : Feature.property = Text (Feature.utc (started +. s.time)) in
    let parts = List.map (fun run -> List.rev (List.rev_map sample run)) (Summary.runs v) in
    Some
      { name = v.id; geometry = Track parts;
        properties = [ ("what", Text "track"); ("type", Text v.kind); ("from", at first); ("until", at last) ] }

let starts ~started (v : Summary.vehicle) =
  let start ((t : Summary.task), p) : Feature.t =
    let at time : Feature.property = Text (Feature.utc (started +. time)) in
    { name = t.plan; geometry = Point p;
      properties =
        [ ("what", Text "task"); ("vehicle", Text v.id); ("from", at t.from); ("until", at t.until);
          ("ending", Text (ending t.ending)) ] }
  in
  List.map start (Summary.places v)

let run_columns = [ "time"; "utc"; "vehicle"; "type"; "latitude"; "longitude"; "height"; "battery"; "task" ]

let run_rows ~started (v : Summary.vehicle) =
  let row ((s : Summary.sample), task) =
    let task : Feature.property = Text (match task with Some (t : Summary.task) -> t.plan | None -> "") in
    let battery : Feature.property =
      match s.battery with Some share -> Number (Map_text.rounded 6 share) | None -> Text "" in
    let vehicle : Feature.property list = [ Text v.id; Text v.kind ] in
    let time : Feature.property list = [ Number (Map_text.rounded 3 s.time); Text (Feature.utc (started +. s.time)) ] in
    (s.time, time @ vehicle @ coordinates s.position @ [ battery; task ])
  in
  List.rev (List.rev_map row (Summary.working v))

let of_run (run : Summary.t) =
  let started = Option.bind run.header (fun h -> Header.of_utc h.started) |> Option.value ~default:0. in
  let rows = List.concat_map (run_rows ~started) run.vehicles in
  { until = started +. run.duration;
    title = Option.fold run.header ~none:"a run" ~some:(fun (h : Header.t) -> Filename.basename h.program.path);
    features =
      List.filter_map (track ~started) run.vehicles @ List.concat_map (starts ~started) run.vehicles;
    columns = run_columns;
    rows = List.rev (List.rev_map snd (List.stable_sort (fun (a, _) (b, _) -> Float.compare a b) rows));
    messages = lazy (Recorded.of_run ~started run) }

(* {1 Plans} *)

let plan_features name (legs : Inline_plan.leg list) : Feature.t list =
  let way = List.concat_map (fun (leg : Inline_plan.leg) -> leg.waypoints) legs in
  let stop i (leg : Inline_plan.leg) : Feature.t option =
    match List.rev leg.waypoints with
    | [] -> None
    | last :: _ ->
      let dwell : Feature.property = if leg.dwell = infinity then Text "without end" else Number leg.dwell in
      Some
        { name = leg.named; geometry = Point last;
          properties =
            [ ("what", Text "maneuver"); ("plan", Text name); ("number", Number (float_of_int (i + 1)));
              ("speed", Number leg.speed); ("dwell", dwell) ] }
  in
  let line : Feature.t list =
    match way with
    | [] | [ _ ] -> []
    | way -> [ { name; geometry = Line way; properties = [ ("what", Text "plan") ] } ] in
  line @ List.filter_map Fun.id (List.mapi stop legs)

let plan_columns = [ "plan"; "maneuver"; "latitude"; "longitude"; "height"; "speed" ]

let plan_rows name legs =
  let row (leg : Inline_plan.leg) p : Feature.property list =
    Feature.Text name :: Text leg.named :: (coordinates p @ [ Feature.Number leg.speed ]) in
  List.concat_map (fun (leg : Inline_plan.leg) -> List.map (row leg) leg.waypoints) legs

let of_plans ~title found =
  let way ({ name; plan; from; speed; vehicles = _ } : Inline_plans.found) =
    Option.map (fun plan -> (name, Inline_plan.path ~from ~speed plan)) plan in
  let ways = List.filter_map way found in
  { title; until = 0.;
    features = List.concat_map (fun (name, legs) -> plan_features name legs) ways;
    columns = plan_columns;
    rows = List.concat_map (fun (name, legs) -> plan_rows name legs) ways;
    messages = lazy (Recorded.of_plans (List.map (fun (name, legs) -> (name, plan_features name legs)) ways)) }

(* {1 Writing} *)

let to_string (format : Dolphin_maps.Map_format.t) map =
  match format with
  | Csv -> Map_text.csv map.columns map.rows
  | Geojson -> Map_text.geojson map.features
  | Kml -> Map_text.kml ~title:map.title map.features
  | Gpx -> Map_text.gpx ~title:map.title map.features
  | Mcap -> Dolphin_maps.Mcap_file.to_string (Lazy.force map.messages)

let last_year : Dolphin_maps.Map_format.t -> int = function
  | Csv | Geojson | Kml | Gpx -> 9999
  | Mcap -> Dolphin_maps.Mcap_file.last_year

let write format path map =
  let bad_input why = Error (Error.Bad_input (map.title ^ ": " ^ why)) in
  let last_year = last_year format in
  if map.features = [] then bad_input "nothing here has a place on a map"
  else if map.until >= Feature.begin_of_year (last_year + 1) then
    bad_input (Printf.sprintf "the run ends after the year %d, the last one of this format" last_year)
  else
    let text = to_string format map in
    match path with
    | None -> print_string text; Ok ()
    | Some path -> Text_file.write path (fun channel -> output_string channel text)
