open Dolphin_plans
open Dolphin_geo
open Data

let of_position (p : Position.t) : json = `List [ of_float p.latitude; of_float p.longitude; of_float p.height ]

let position : json -> Position.t = function
  | `List [ latitude; longitude; height ] as json -> (
      match Position.make ~latitude:(float latitude) ~longitude:(float longitude) ~height:(float height) with
      | Ok p -> p
      | Error _ -> wrong "a position" json)
  | json -> wrong "a position" json

(* Names of constructors without parts, in both directions. *)
let speed_units = [ (Plan.Metres_per_second, "m/s"); (Revolutions_per_minute, "rpm"); (Percent, "percent") ]
let z_units = [ (Plan.Depth, "depth"); (Altitude, "altitude"); (Height, "height"); (Unspecified, "unspecified") ]

let directions =
  [ (Plan.Vehicle_dependent, "vehicle-dependent"); (Clockwise, "clockwise"); (Counter_clockwise, "counter-clockwise");
    (Into_wind_or_current, "into-wind-or-current") ]

let of_name names x : json = `String (List.assoc x names)

let name names json =
  let named = text json in
  match List.find_opt (fun (_, name) -> String.equal name named) names with
  | Some (x, _) -> x
  | None -> wrong "a name that is known here" json

let of_kind : Plan.kind -> json = function
  | Go_to -> tagged "goTo" []
  | Launch -> tagged "launch" []
  | Loiter { radius; duration; direction } ->
    tagged "loiter" [ of_float radius; of_float duration; of_name directions direction ]
  | Yo_yo { amplitude; pitch } -> tagged "yoyo" [ of_float amplitude; of_float pitch ]
  | Pop_up { duration; current_position; wait_at_surface; station_keep } ->
    tagged "popup" [ of_float duration; `Bool current_position; `Bool wait_at_surface; `Bool station_keep ]
  | Station_keeping { radius; duration } -> tagged "skeeping" [ of_float radius; of_float duration ]
  | Compass_calibration { amplitude; radius; pitch; duration; direction } ->
    let numbers = List.map of_float [ amplitude; radius; pitch; duration ] in
    tagged "compassCalibration" (numbers @ [ of_name directions direction ])
  | Rows r ->
    let numbers =
      [ r.bearing; r.cross_angle; r.width; r.length; r.horizontal_step; r.curve_offset; r.alternation ] in
    tagged "rows" (List.map of_float numbers @ [ `Bool r.square_curve; `Bool r.first_curve_right ])
  | Follow_path points ->
    tagged "followPath" (List.map (fun (north, east, down) -> of_list of_float [ north; east; down ]) points)

let point : json -> float * float * float = function
  | `List [ north; east; down ] -> (float north, float east, float down)
  | json -> wrong "a point" json

let rows : json list -> Plan.kind option = function
  | [ bearing; cross_angle; width; length; step; offset; alternation; square_curve; first_curve_right ] ->
    Some
      (Rows
         { bearing = float bearing; cross_angle = float cross_angle; width = float width; length = float length;
           horizontal_step = float step; curve_offset = float offset; alternation = float alternation;
           square_curve = truth square_curve; first_curve_right = truth first_curve_right })
  | _ -> None

let kind (json : json) : Plan.kind =
  match json with
  | `List [ `String "goTo" ] -> Go_to
  | `List [ `String "launch" ] -> Launch
  | `List [ `String "loiter"; radius; duration; direction ] ->
    Loiter { radius = float radius; duration = float duration; direction = name directions direction }
  | `List [ `String "yoyo"; amplitude; pitch ] -> Yo_yo { amplitude = float amplitude; pitch = float pitch }
  | `List [ `String "popup"; duration; current_position; wait_at_surface; station_keep ] ->
    Pop_up
      { duration = float duration; current_position = truth current_position;
        wait_at_surface = truth wait_at_surface; station_keep = truth station_keep }
  | `List [ `String "skeeping"; radius; duration ] ->
    Station_keeping { radius = float radius; duration = float duration }
  | `List [ `String "compassCalibration"; amplitude; radius; pitch; duration; direction ] ->
    Compass_calibration
      { amplitude = float amplitude; radius = float radius; pitch = float pitch; duration = float duration;
        direction = name directions direction }
  | `List (`String "followPath" :: points) -> Follow_path (List.map point points)
  | `List (`String "rows" :: parts) -> (
      match rows parts with Some kind -> kind | None -> wrong "a maneuver" json)
  | json -> wrong "a maneuver" json

let of_payload (d : Plan.payload) : json =
  `List [ `String d.name; of_list (of_pair (fun k -> `String k) (fun x -> `String x)) d.parameters ]

let payload json : Plan.payload =
  let name, parameters = pair text (list (pair text text)) json in
  { name; parameters }

let of_maneuver (m : Plan.maneuver) : json =
  `List
    [ `String m.id; of_kind m.kind; of_position m.location; of_pair of_float (of_name speed_units) m.speed;
      of_pair of_float (of_name z_units) m.z; of_list of_payload m.payloads ]

let maneuver : json -> Plan.maneuver = function
  | `List [ id; its_kind; location; speed; z; payloads ] ->
    { id = text id; kind = kind its_kind; location = position location; speed = pair float (name speed_units) speed;
      z = pair float (name z_units) z; payloads = list payload payloads }
  | json -> wrong "a maneuver" json

let to_json (p : Plan.t) : json =
  `List
    [ `String p.name; `String p.description; of_list (fun v -> `String v) p.vehicles; of_list of_maneuver p.maneuvers ]

let of_json : json -> Plan.t = function
  | `List [ name; description; vehicles; maneuvers ] as json ->
    let maneuvers = list maneuver maneuvers in
    if maneuvers = [] then wrong "a plan" json
    else { name = text name; description = text description; vehicles = list text vehicles; maneuvers }
  | json -> wrong "a plan" json

(* {1 Missions} *)

let of_argument : Mission_plan.argument -> json = function
  | Number x -> tagged "number" [ of_float x ]
  | Truth b -> tagged "boolean" [ `Bool b ]
  | Text x -> tagged "string" [ `String x ]
  | Place p -> tagged "position" [ of_position p ]
  | Places ps -> tagged "positions" (List.map of_position ps)

let argument : json -> Mission_plan.argument = function
  | `List [ `String "number"; x ] -> Number (float x)
  | `List [ `String "boolean"; b ] -> Truth (truth b)
  | `List [ `String "string"; x ] -> Text (text x)
  | `List [ `String "position"; p ] -> Place (position p)
  | `List (`String "positions" :: ps) -> Places (List.map position ps)
  | json -> wrong "an argument of a mission's item" json

let of_item (i : Mission_plan.item) : json =
  `List [ `String i.word; of_list (of_pair (fun k -> `String k) of_argument) i.arguments ]

let item json : Mission_plan.item =
  let word, arguments = pair text (list (pair text argument)) json in
  { word; arguments }

let rec of_inline : Inline_plan.t -> json = function
  | Rest { whole; share; plan } ->
    let share = of_option of_float share in
    `Assoc [ ("rest", `List [ of_inline whole; share; of_inline plan ]) ]
  | Maneuvers p -> to_json p
  | Mission m ->
    let vehicles = of_list (fun v -> `String v) m.vehicles in
    `Assoc [ ("mission", `List [ `String m.name; vehicles; of_list of_item m.items ]) ]

let rec inline : json -> Inline_plan.t = function
  | `Assoc [ ("rest", `List [ whole; share; plan ]) ] ->
    Rest { whole = inline whole; share = option float share; plan = inline plan }
  | `Assoc [ ("mission", `List [ name; vehicles; items ]) ] ->
    Mission { name = text name; vehicles = list text vehicles; items = list item items }
  | json -> Maneuvers (of_json json)
