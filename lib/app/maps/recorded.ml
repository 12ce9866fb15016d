open Dolphin_trace
open Dolphin_maps

type json = Yojson.Safe.t

(* {1 Schemas: those that Foxglove knows by their names, and one of ours} *)

let described kind members : json = `Assoc (("type", `String kind) :: members)
let number = described "number" []
let text = described "string" []
let whole = described "integer" [ ("minimum", `Int 0) ]
let whole_to most = described "integer" [ ("minimum", `Int 0); ("maximum", `Int most) ]

let time =
  described "object"
    [ ("title", `String "time"); ("properties", `Assoc [ ("sec", whole); ("nsec", whole_to 999_999_999) ]) ]

let schema name members : Mcap_file.schema =
  { name;
    json_schema = described "object" [ ("title", `String name); ("properties", `Assoc members) ] }

let location_fix =
  schema "foxglove.LocationFix"
    [ ("timestamp", time); ("frame_id", text); ("latitude", number); ("longitude", number); ("altitude", number);
      ("position_covariance",
       described "array" [ ("items", number); ("minItems", `Int 9); ("maxItems", `Int 9) ]);
      ("position_covariance_type", whole_to 3) ]

let log =
  schema "foxglove.Log"
    [ ("timestamp", time); ("level", whole_to 5); ("message", text); ("name", text); ("file", text);
      ("line", whole) ]

let geojson = schema "foxglove.GeoJSON" [ ("geojson", text) ]

let vehicle =
  schema "dolphin.Vehicle"
    [ ("timestamp", time); ("vehicle", text); ("type", text); ("height", number);
      ("battery", `Assoc [ ("type", `List [ `String "number"; `String "null" ]) ]); ("task", text) ]

(* {1 Messages} *)

let timestamp at : json =
  let seconds, rest = Mcap_file.nanoseconds at in
  `Assoc [ ("sec", `Int seconds); ("nsec", `Int rest) ]

let message topic schema time members : Mcap_file.message =
  { channel = { topic; schema }; time; content = `Assoc members }

let stamped topic schema at members = message topic schema at (("timestamp", timestamp at) :: members)

let features topic at found =
  message topic geojson at [ ("geojson", `String (Map_text.geojson found)) ]

(* {1 Runs} *)

let location ~started (v : Summary.vehicle) (s : Summary.sample) =
  stamped ("/" ^ v.id ^ "/location") location_fix (started +. s.time)
    [ ("frame_id", `String v.id); ("latitude", `Float s.position.latitude); ("longitude", `Float s.position.longitude);
      ("altitude", `Float s.position.height); ("position_covariance", `List (List.init 9 (fun _ -> `Float 0.)));
      ("position_covariance_type", `Int 0) ]

let state ~started (v : Summary.vehicle) (s : Summary.sample) task =
  let battery = Option.fold s.battery ~none:`Null ~some:(fun share -> `Float share) in
  stamped ("/" ^ v.id ^ "/state") vehicle (started +. s.time)
    [ ("vehicle", `String v.id); ("type", `String v.kind); ("height", `Float s.position.height); ("battery", battery);
      ("task", `String (Option.fold task ~none:"" ~some:(fun (t : Summary.task) -> t.plan))) ]

let plan ~started (v : Summary.vehicle) (t : Summary.task) =
  match t.way with
  | Some (Path (_ :: _ :: _ as way)) ->
    let line : Feature.t = { name = t.plan; geometry = Line way; properties = [ ("vehicle", Text v.id) ] } in
    Some (features ("/" ^ v.id ^ "/plan") (started +. t.from) [ line ])
  | Some (Path ([] | [ _ ]) | By_name) | None -> None

(* Levels of foxglove.Log. *)
let debug, info, warning, error = (1, 2, 3, 4)

let said ~started time level name words =
  stamped "/log" log (started +. time)
    [ ("level", `Int level); ("message", `String words); ("name", `String name); ("file", `String "");
      ("line", `Int 0) ]

let log_of_task ~started (v : Summary.vehicle) (t : Summary.task) =
  let say = said ~started in
  let ending =
    match t.ending with
    | Done -> [ say t.until info v.id ("ends " ^ t.plan) ]
    | Failed why -> [ say t.until error v.id (Printf.sprintf "fails in %s: %s" t.plan why) ]
    | Stopped -> [ say t.until info v.id ("stops " ^ t.plan) ]
    | Unfinished -> []
  in
  say t.from info v.id ("starts " ^ t.plan) :: ending

let log_of_silence ~started (run : Summary.t) (v : Summary.vehicle) (s : Summary.span) =
  let say = said ~started in
  say s.from warning v.id "loses its link"
  :: (if s.until < run.duration then [ say s.until info v.id "has its link back" ] else [])

let log_of_program ~started (time, (activity : Summary.activity)) =
  let say level words = said ~started time level "program" words in
  match activity with
  | Posted pair -> say debug ("posts " ^ pair)
  | Consumed pair -> say debug ("consumes " ^ pair)
  | Said words -> say info words
  | Asked question -> say info ("asks: " ^ question)
  | Erred why -> say error why

let log_of_end ~started (run : Summary.t) =
  match run.ending with
  | None -> []
  | Some { how; message } ->
    let words = Option.fold message ~none:how ~some:(fun m -> how ^ ": " ^ m) in
    [ said ~started run.duration (if how = "completed" then info else error) "program" words ]

(* Events of one time stand in this order. *)
let log_of_run ~started (run : Summary.t) =
  let each f = List.concat_map f run.vehicles in
  let hold words time (v : Summary.vehicle) =
    List.map (fun span -> said ~started (time span) info v.id words) v.held in
  (* A long run has more activities than the stack has room for: neither [List.map] nor [@]. *)
  List.concat_map Fun.id
    [ each (hold "is picked" (fun (s : Summary.span) -> s.from));
      each (fun v -> List.concat_map (log_of_silence ~started run v) v.silent);
      each (fun v -> List.concat_map (log_of_task ~started v) v.tasks);
      List.concat_map (fun activity -> [ log_of_program ~started activity ]) run.activities;
      each (hold "is released" (fun (s : Summary.span) -> s.until));
      log_of_end ~started run ]

let of_run ~started (run : Summary.t) =
  let of_vehicle (v : Summary.vehicle) =
    let sample (s, task) = [ location ~started v s; state ~started v s task ] in
    List.concat_map sample (Summary.working v) @ List.filter_map (plan ~started v) v.tasks in
  List.concat_map of_vehicle run.vehicles @ log_of_run ~started run

(* {1 Plans} *)

let of_plans plans =
  let known = Hashtbl.create 16 in
  let of_plan (name, found) =
    let n = 1 + Option.value (Hashtbl.find_opt known name) ~default:0 in
    Hashtbl.replace known name n;
    features (if n = 1 then "/" ^ name else Printf.sprintf "/%s (%d)" name n) 0. found
  in
  List.map of_plan plans
