open Dolphin_plans
open Dolphin_semantics
open Dolphin_geo
open Dolphin_json
open Field
module Results = Dolphin_results.Results

type json = Yojson.Safe.t

let of_text x : json = `String x
let of_float x : json = `Float x
let of_truth x : json = `Bool x

(* Names of constructors without parts, in both directions. *)
let speed_units = [ (Plan.Metres_per_second, "m/s"); (Revolutions_per_minute, "rpm"); (Percent, "percent") ]
let z_units = [ (Plan.Depth, "depth"); (Altitude, "altitude"); (Height, "height"); (Unspecified, "unspecified") ]

let directions =
  [ (Plan.Vehicle_dependent, "vehicle-dependent"); (Clockwise, "clockwise"); (Counter_clockwise, "counter-clockwise");
    (Into_wind_or_current, "into-wind-or-current") ]

let name_of names x = of_text (List.assoc x names)

let named names json =
  let* name = Field.text json in
  match List.find_opt (fun (_, other) -> String.equal name other) names with
  | Some (x, _) -> Ok x
  | None -> Error (Printf.sprintf "'%s', not one of %s" name (String.concat ", " (List.map snd names)))

(* {1 Writing} *)

let of_kind : Plan.kind -> string * (string * json) list = function
  | Go_to -> ("goTo", [])
  | Launch -> ("launch", [])
  | Loiter { radius; duration; direction } ->
    ( "loiter",
      [ ("radius", of_float radius); ("duration", of_float duration); ("direction", name_of directions direction) ] )
  | Yo_yo { amplitude; pitch } -> ("yoyo", [ ("amplitude", of_float amplitude); ("pitch", of_float pitch) ])
  | Pop_up { duration; current_position; wait_at_surface; station_keep } ->
    ( "popup",
      [ ("duration", of_float duration); ("currentPosition", of_truth current_position);
        ("waitAtSurface", of_truth wait_at_surface); ("stationKeep", of_truth station_keep) ] )
  | Station_keeping { radius; duration } ->
    ("skeeping", [ ("radius", of_float radius); ("duration", of_float duration) ])
  | Compass_calibration { amplitude; radius; pitch; duration; direction } ->
    ( "compassCalibration",
      [ ("amplitude", of_float amplitude); ("radius", of_float radius); ("pitch", of_float pitch);
        ("duration", of_float duration); ("direction", name_of directions direction) ] )
  | Rows r ->
    ( "rows",
      [ ("bearing", of_float r.bearing); ("crossAngle", of_float r.cross_angle); ("width", of_float r.width);
        ("length", of_float r.length); ("horizontalStep", of_float r.horizontal_step);
        ("curveOffset", of_float r.curve_offset); ("alternation", of_float r.alternation);
        ("squareCurve", of_truth r.square_curve); ("firstCurveRight", of_truth r.first_curve_right) ] )
  | Follow_path points ->
    let point (north, east, down) : json = `List [ of_float north; of_float east; of_float down ] in
    ("followPath", [ ("points", `List (List.map point points)) ])

let of_place (p : Position.t) : json =
  `Assoc
    [ ("latitude", of_float p.latitude); ("longitude", of_float p.longitude); ("height", of_float p.height) ]

let of_payload (d : Plan.payload) : json =
  `Assoc [ ("name", of_text d.name); ("parameters", `Assoc (List.map (fun (k, x) -> (k, of_text x)) d.parameters)) ]

let of_maneuver (m : Plan.maneuver) : json =
  let kind, members = of_kind m.kind in
  let speed, speed_unit = m.speed and z, z_unit = m.z in
  `Assoc
    ([ ("id", of_text m.id); ("maneuver", of_text kind); ("latitude", of_float m.location.latitude);
       ("longitude", of_float m.location.longitude); ("height", of_float m.location.height); ("z", of_float z);
       ("zUnit", name_of z_units z_unit); ("speed", of_float speed); ("speedUnit", name_of speed_units speed_unit);
       ("payload", `List (List.map of_payload m.payloads)) ]
     @ members)

let of_plan (p : Plan.t) : json =
  `Assoc
    [ ("description", of_text p.description); ("vehicles", Field.texts p.vehicles);
      ("maneuvers", `List (List.map of_maneuver p.maneuvers)) ]

let of_argument : Mission_plan.argument -> json = function
  | Number x -> of_float x
  | Truth b -> of_truth b
  | Text text -> of_text text
  | Place p -> of_place p
  | Places ps -> `List (List.map of_place ps)

let of_item (i : Mission_plan.item) : json =
  let named = List.map (fun (name, x) -> (name, of_argument x)) i.arguments in
  `Assoc [ ("item", of_text i.word); ("arguments", `List []); ("named", `Assoc named) ]

let of_mission (m : Mission_plan.t) : json =
  `Assoc [ ("vehicles", Field.texts m.vehicles); ("items", `List (List.map of_item m.items)) ]

let language (task : Core.platform_task) =
  match task.plan with
  | None -> "name"
  | Some (Maneuvers _) -> "imcPlan"
  | Some (Mission _) -> "mission"

let to_json (task : Core.platform_task) : json =
  let described =
    match task.plan with
    | None -> []
    | Some plan ->
      let body = match plan with Maneuvers p -> of_plan p | Mission m -> of_mission m in
      [ ("language", of_text (language task)); ("body", body) ]
  in
  `Assoc (("name", of_text task.name) :: described)

(* {1 Reading} *)

let point = function
  | `List [ north; east; down ] ->
    let* north = number north in
    let* east = number east in
    let* down = number down in
    Ok (north, east, down)
  | _ -> Error "a point is [north, east, down]"

let rows members : (Plan.kind, string) result =
  let* bearing = get number "bearing" members in
  let* cross_angle = get number "crossAngle" members in
  let* width = get number "width" members in
  let* length = get number "length" members in
  let* horizontal_step = get number "horizontalStep" members in
  let* curve_offset = get number "curveOffset" members in
  let* alternation = get number "alternation" members in
  let* square_curve = get Field.truth "squareCurve" members in
  let* first_curve_right = get Field.truth "firstCurveRight" members in
  Ok
    (Plan.Rows
       { bearing; cross_angle; width; length; horizontal_step; curve_offset; alternation; square_curve;
         first_curve_right })

let pop_up members : (Plan.kind, string) result =
  let* duration = get number "duration" members in
  let* current_position = get Field.truth "currentPosition" members in
  let* wait_at_surface = get Field.truth "waitAtSurface" members in
  let* station_keep = get Field.truth "stationKeep" members in
  Ok (Plan.Pop_up { duration; current_position; wait_at_surface; station_keep })

let calibration members : (Plan.kind, string) result =
  let* amplitude = get number "amplitude" members in
  let* radius = get number "radius" members in
  let* pitch = get number "pitch" members in
  let* duration = get number "duration" members in
  let* direction = get (named directions) "direction" members in
  Ok (Plan.Compass_calibration { amplitude; radius; pitch; duration; direction })

let circle members =
  let* radius = get number "radius" members in
  let* duration = get number "duration" members in
  Ok (radius, duration)

let kind members : (Plan.kind, string) result =
  let* name = get Field.text "maneuver" members in
  match name with
  | "goTo" -> Ok Plan.Go_to
  | "launch" -> Ok Plan.Launch
  | "loiter" ->
    let* radius, duration = circle members in
    let* direction = get (named directions) "direction" members in
    Ok (Plan.Loiter { radius; duration; direction })
  | "skeeping" ->
    let* radius, duration = circle members in
    Ok (Plan.Station_keeping { radius; duration })
  | "yoyo" ->
    let* amplitude = get number "amplitude" members in
    let* pitch = get number "pitch" members in
    Ok (Plan.Yo_yo { amplitude; pitch })
  | "popup" -> pop_up members
  | "compassCalibration" -> calibration members
  | "rows" -> rows members
  | "followPath" ->
    let* points = get (list point) "points" members in
    Ok (Plan.Follow_path points)
  | name -> Error (Printf.sprintf "unknown maneuver '%s'" name)

let payload json : (Plan.payload, string) result =
  let* payload = members json in
  let* name = get Field.text "name" payload in
  let* parameters = get members "parameters" payload in
  let* parameters = Results.map_values Field.text parameters in
  Ok { Plan.name; parameters }

let location members =
  let* latitude = get number "latitude" members in
  let* longitude = get number "longitude" members in
  let* height = get number "height" members in
  Result.map_error (fun _ -> "a position out of range") (Position.make ~latitude ~longitude ~height)

let maneuver json : (Plan.maneuver, string) result =
  let* m = members json in
  let* id = get Field.text "id" m in
  let within what = Result.map_error (fun why -> Printf.sprintf "maneuver %s: %s" id why) what in
  within
    (let* kind = kind m in
     let* location = location m in
     let* speed = get number "speed" m in
     let* speed_unit = get (named speed_units) "speedUnit" m in
     let* z = get number "z" m in
     let* z_unit = get (named z_units) "zUnit" m in
     let* payloads = get (list payload) "payload" m in
     Ok { Plan.id; kind; location; speed = (speed, speed_unit); z = (z, z_unit); payloads })

let plan ~name json : (Plan.t, string) result =
  let* body = members json in
  let* description = get Field.text "description" body in
  let* vehicles = get (list Field.text) "vehicles" body in
  let* maneuvers = get (list maneuver) "maneuvers" body in
  if maneuvers = [] then Error "a plan has one maneuver at least"
  else Ok { Plan.name; description; vehicles; maneuvers }

let argument json : (Mission_plan.argument, string) result =
  let place json = Result.bind (members json) location in
  match json with
  | `Bool b -> Ok (Mission_plan.Truth b)
  | `String text -> Ok (Mission_plan.Text text)
  | `Assoc _ -> Result.map (fun p -> Mission_plan.Place p) (place json)
  | `List places -> Result.map (fun ps -> Mission_plan.Places ps) (Results.map place places)
  | _ -> Result.map (fun x -> Mission_plan.Number x) (number json)

(* Dolphin names every argument. *)
let item json : (Mission_plan.item, string) result =
  let* members' = members json in
  let* word = get Field.text "item" members' in
  let within what = Result.map_error (fun why -> Printf.sprintf "item %s: %s" word why) what in
  within
    (let* unnamed = get (list argument) "arguments" members' in
     let* named = get members "named" members' in
     let* arguments = Results.map_values argument named in
     if unnamed = [] then Ok { Mission_plan.word; arguments } else Error "its arguments have no names")

let mission ~name json : (Mission_plan.t, string) result =
  let* body = members json in
  let* vehicles = get (list Field.text) "vehicles" body in
  let* items = get (list item) "items" body in
  if items = [] then Error "a mission has one item at least" else Ok { Mission_plan.name; vehicles; items }

let of_json json : (Core.platform_task, string) result =
  let* members = members json in
  let* name = get Field.text "name" members in
  match List.assoc_opt "language" members with
  | None | Some `Null -> Ok { Core.name; plan = None; task_site = 0 }
  | Some (`String "imcPlan") ->
    let* plan = get (plan ~name) "body" members in
    Ok { Core.name; plan = Some (Maneuvers plan); task_site = 0 }
  | Some (`String "mission") ->
    let* mission = get (mission ~name) "body" members in
    Ok { Core.name; plan = Some (Mission mission); task_site = 0 }
  | Some (`String language) -> Error (Printf.sprintf "plans in the language '%s' are not known here" language)
  | Some _ -> Error "the language of a plan is a text"
