open Core
module Position = Dolphin_geo.Position
module Wgs84 = Dolphin_geo.Wgs84

let ( let* ) = Result.bind

(* {1 Faults} *)

let fault s format = Format.kasprintf (fun message -> Error (Fault.make s.setting_site message)) format
let wrong s what x = Result.map_error (Fault.make s.setting_site) (Operators.expected what x)
let listed = String.concat ", "

(* What to say after a word [x] that is none of [xs]. *)
let instead x xs ~otherwise =
  match Dolphin_syntax.Diagnostic.suggest x xs with
  | Some likely -> Printf.sprintf "did you mean %s?" likely
  | None -> otherwise ^ " " ^ listed xs

(* {1 Reading values}

   A reader takes the setting that a value belongs to, what the value is there, such as "radius of loiter", and the
   value. *)

let string s what = function
  | String "" -> fault s "%s is empty" what
  | String text -> Ok text
  | x -> wrong s (Printf.sprintf "a string as %s" what) x

let boolean s what = function
  | Boolean b -> Ok b
  | x -> wrong s (Printf.sprintf "true or false as %s" what) x

let number s what x =
  match Value.to_number x with
  | Some n when Float.is_finite n -> Ok n
  | Some n -> fault s "%s is a finite number, not %g" what n
  | None -> wrong s (Printf.sprintf "a number as %s" what) x

let within from upto unit s what x =
  let* n = number s what x in
  if from <= n && n <= upto then Ok n else fault s "%s is from %.15g to %.15g%s, not %.15g" what from upto unit n

let positive upto unit s what x =
  let* n = number s what x in
  if 0. < n && n <= upto then Ok n
  else fault s "%s is greater than 0 and at most %.15g%s, not %.15g" what upto unit n

(* The longest of lengths is IMC's of radii. *)
let longest = 100_000.
let length s = within 0. longest " m" s
let radius s = within 1. longest " m" s

(* Units and arithmetic leave traces: 2.3.minutes is not quite 138 seconds. *)
let whole upto unit s what x =
  let* n = number s what x in
  let rounded = Float.round n in
  if 0. <= rounded && rounded <= upto && Float.abs (n -. rounded) < 1e-6 then Ok (Float.abs rounded)
  else fault s "%s is a whole number from 0 to %.15g%s, not %.15g" what upto unit n

let seconds s = whole 65535. " seconds" s

(* [50.percent] is 0.5 in the language, but a plan counts percent from 0 to 100. *)
let percent s what x =
  let* n = number s what x in
  if n > 0. && n <= 1. then
    fault s "%s counts percent from 0 to 100, and %.15g is hardly meant: write 50 for half, not 50.percent" what n
  else within 0. 100. " percent" s what x

let bearing s what x =
  let* degrees = within (-360.) 360. " degrees" s what x in
  let degrees = if degrees < 0. then degrees +. 360. else degrees in
  Ok (if degrees = 360. then 0. else degrees)

let coordinates s latitude longitude =
  let* latitude = number s "latitude" latitude in
  let* longitude = number s "longitude" longitude in
  Position.make ~latitude ~longitude ~height:0.
  |> Result.map_error (fun e -> Fault.make s.setting_site (Format.asprintf "%a" Position.pp_error e))

let position s what = function
  | Position p -> Ok p
  | List [| latitude; longitude |] -> coordinates s latitude longitude
  | x -> wrong s (Printf.sprintf "a position %s" what) x

let rec each read = function
  | [] -> Ok []
  | x :: xs ->
    let* y = read x in
    let* ys = each read xs in
    Ok (y :: ys)

(* {1 Quantities with a unit: speeds and z} *)

let speed_units : (string * Plan.speed_unit) list =
  [ ("Speed.Units.METERS_PS", Metres_per_second);
    ("Speed.Units.RPM", Revolutions_per_minute);
    ("Speed.Units.PERCENTAGE", Percent) ]

let z_units : (string * Plan.z_unit) list =
  [ ("Z.Units.DEPTH", Depth); ("Z.Units.ALTITUDE", Altitude); ("Z.Units.HEIGHT", Height);
    ("Z.Units.NONE", Unspecified) ]

let units = List.map fst speed_units @ List.map fst z_units

(* A unit may go by its last names, and as a string in any case: 'rpm'. *)
let unit_of known s what x =
  let names text =
    let text = String.lowercase_ascii text in
    fun (name, _) ->
      let name = String.lowercase_ascii name in
      name = text || String.ends_with ~suffix:("." ^ text) name
  in
  match x with
  | Symbol text | String text -> (
      match List.find_opt (names text) known with
      | Some (_, unit) -> Ok unit
      | None ->
        fault s "'%s' is no unit of %s: %s" text what (instead text (List.map fst known) ~otherwise:"units are"))
  | x -> wrong s (Printf.sprintf "a unit of %s, as in %s" what (fst (List.hd known))) x

(* [quantity known default s what xs] is the number and the unit that [xs] are, spread out or as a list. *)
let quantity known default s what xs =
  match (match xs with [ List ys ] -> Array.to_list ys | xs -> xs) with
  | [ n ] ->
    let* n = number s what n in
    Ok (n, default)
  | [ n; unit ] ->
    let* unit = unit_of known s what unit in
    let* n = number s what n in
    Ok (n, unit)
  | [] | _ :: _ -> fault s "%s is a number and a unit, as in %s 1, %s" what what (fst (List.hd known))

let fastest = 100.

let speed default s xs =
  let* n, unit = quantity speed_units default s "speed" xs in
  let* n =
    match unit with
    | Metres_per_second when n > fastest ->
      fault s "speed is at most %g m/s, not %.15g: if the unit is another, name it, as in speed %.15g, %s" fastest n n
        "Speed.Units.RPM"
    | Metres_per_second -> positive fastest " m/s" s "speed" (Number n)
    | Revolutions_per_minute -> positive 100_000. " RPM" s "speed" (Number n)
    | Percent ->
      let* n = percent s "speed" (Number n) in
      positive 100. " percent" s "speed" (Number n)
  in
  Ok (n, unit)

let z default s xs =
  let* n, (unit : Plan.z_unit) = quantity z_units default s "z" xs in
  let* n =
    match unit with
    | Depth -> length s "depth" (Number n)
    | Altitude -> length s "altitude" (Number n)
    | Height | Unspecified -> within (-.longest) longest " m" s "z" (Number n)
  in
  Ok (n, unit)

(* {1 Payload} *)

(* DUNE's entities and their parameters are written so: High-Frequency Channels. *)
let capitalised text =
  String.split_on_char ' ' text
  |> List.filter (fun word -> word <> "")
  |> List.map String.capitalize_ascii
  |> String.concat " "

let parameter s device (name, x) =
  match x with
  | Boolean _ | Integer _ | Number _ | String _ -> Ok (capitalised name, Value.to_string (Value.canonical x))
  | x -> wrong s (Printf.sprintf "a number, a string or true or false as %s of %s" name device) x

let device s what = function
  | String _ as name ->
    let* name = string s what name in
    Ok { Plan.name = capitalised name; parameters = [ ("Active", "true") ] }
  | Map entries -> (
      match List.assoc_opt "name" entries with
      | None -> fault s "%s lacks its name, as in [name:'Camera']" what
      | Some name ->
        let* name = string s ("name in " ^ what) name in
        let* parameters = each (parameter s name) (List.remove_assoc "name" entries) in
        let active, others = List.partition (fun (k, _) -> k = "Active") parameters in
        let active = if active = [] then [ ("Active", "true") ] else active in
        Ok { Plan.name = capitalised name; parameters = active @ others })
  | x -> wrong s (Printf.sprintf "devices as %s, as in [[name:'Camera', Frequency:50]]" what) x

let devices s what = function
  | List xs -> each (device s what) (Array.to_list xs)
  | x ->
    let* payload = device s what x in
    Ok [ payload ]

(* {1 Maneuvers} *)

let argument s name ~default read =
  match List.assoc_opt name s.named with
  | None -> Ok default
  | Some x -> read s (Printf.sprintf "%s of %s" name s.setting) x

let directions : (string * Plan.direction) list =
  [ ("VDEP", Vehicle_dependent); ("CLOCKW", Clockwise); ("CCLOCKW", Counter_clockwise);
    ("IWINDCURR", Into_wind_or_current) ]

let direction s what x =
  let* text = string s what x in
  match List.assoc_opt (String.uppercase_ascii text) directions with
  | Some direction -> Ok direction
  | None -> fault s "'%s' is no %s: %s" text what (instead text (List.map fst directions) ~otherwise:"there are")

let go_to _ (m : Plan.maneuver) = Ok { m with kind = Go_to }
let launch _ (m : Plan.maneuver) = Ok { m with kind = Launch }

let loiter s (m : Plan.maneuver) =
  let* radius = argument s "radius" ~default:20. radius in
  let* duration = argument s "duration" ~default:60. seconds in
  let* direction = argument s "direction" ~default:Plan.Vehicle_dependent direction in
  Ok { m with kind = Loiter { radius; duration; direction } }

let yo_yo s (m : Plan.maneuver) =
  let* deepest = argument s "max_depth" ~default:20. length in
  let* shallowest = argument s "min_depth" ~default:2. length in
  let* pitch = argument s "pitch" ~default:15. (within 0. 45. " degrees") in
  if pitch = 0. then fault s "with a pitch of 0 degrees, yoyo does not move up and down"
  else if deepest <= shallowest then
    fault s "max_depth of yoyo is deeper than min_depth, but here they are %.15g and %.15g m" deepest shallowest
  else
    let z = ((deepest +. shallowest) /. 2., Plan.Depth) in
    Ok { m with z; kind = Yo_yo { amplitude = deepest -. shallowest; pitch } }

let pop_up s (m : Plan.maneuver) =
  let located = List.mem_assoc "location" s.named in
  let* duration = argument s "duration" ~default:180. seconds in
  let* current_position = argument s "currPos" ~default:(not located) boolean in
  let* wait_at_surface = argument s "waitAtSurface" ~default:false boolean in
  let* station_keep = argument s "stationKeep" ~default:false boolean in
  if located && current_position then
    fault s "popup starts at the current position or at a location, not at both: leave out currPos or location"
  else Ok { m with kind = Pop_up { duration; current_position; wait_at_surface; station_keep } }

let station_keeping s (m : Plan.maneuver) =
  let* radius = argument s "radius" ~default:20. radius in
  let* duration = argument s "duration" ~default:60. seconds in
  Ok { m with kind = Station_keeping { radius; duration } }

let compass_calibration s (m : Plan.maneuver) =
  let* amplitude = argument s "amplitude" ~default:1. length in
  let* radius = argument s "radius" ~default:5. radius in
  let* pitch = argument s "pitch" ~default:15. (within (-90.) 90. " degrees") in
  let* duration = argument s "duration" ~default:300. seconds in
  let* direction = argument s "direction" ~default:Plan.Clockwise direction in
  match snd m.z with
  | Depth | Altitude -> Ok { m with kind = Compass_calibration { amplitude; radius; pitch; duration; direction } }
  | Height | Unspecified -> fault s "compassCalibration needs a z in Z.Units.DEPTH or Z.Units.ALTITUDE"

let most_rows = 10_000.

let rows s (m : Plan.maneuver) =
  let* bearing = argument s "bearing" ~default:0. bearing in
  let* cross_angle = argument s "cross_angle" ~default:0. (within (-60.) 60. " degrees") in
  let* width = argument s "width" ~default:100. length in
  let* length = argument s "length" ~default:200. length in
  let* horizontal_step = argument s "hstep" ~default:27. (positive longest " m") in
  let* curve_offset = argument s "curvOff" ~default:15. (whole 255. " m") in
  let* curve_offset = argument s "coff" ~default:curve_offset (whole 255. " m") in
  let* alternation = argument s "alternation" ~default:100. percent in
  let* alternation = whole 100. " percent" s "alternation of rows" (Number alternation) in
  let* square_curve = argument s "squareCurve" ~default:true boolean in
  let* first_curve_right = argument s "firstCurveRight" ~default:false boolean in
  if width /. horizontal_step > most_rows then
    fault s "hstep of rows is too small: %.15g m in steps of %.15g m are more than %.15g rows" width horizontal_step
      most_rows
  else
    Ok
      { m with
        kind =
          Rows
            { bearing; cross_angle; width; length; horizontal_step; curve_offset; alternation; square_curve;
              first_curve_right };
      }

let no_point = "points of followPath as [north, east], [north, east, down] or positions"

let point_of_map s entries =
  let keys = [ "north"; "east"; "down" ] in
  let coordinate name ~default =
    match List.assoc_opt name entries, default with
    | Some x, _ -> within (-.longest) longest " m" s (name ^ " of a point") x
    | None, Some metres -> Ok metres
    | None, None -> fault s "a point of followPath lacks its %s" name
  in
  match List.find_opt (fun (k, _) -> not (List.mem k keys)) entries with
  | Some (k, _) -> fault s "a point has no '%s': %s" k (instead k keys ~otherwise:"it has")
  | None ->
    let* north = coordinate "north" ~default:None in
    let* east = coordinate "east" ~default:None in
    let* down = coordinate "down" ~default:(Some 0.) in
    Ok (north, east, down)

let point s origin = function
  | List [| north; east |] -> point_of_map s [ ("north", north); ("east", east) ]
  | List [| north; east; down |] -> point_of_map s [ ("north", north); ("east", east); ("down", down) ]
  | Map entries -> point_of_map s entries
  | Position p ->
    let* metres = within 0. longest " m" s "the distance of a point" (Number (Wgs84.distance origin p)) in
    let course = Wgs84.bearing origin p *. Float.pi /. 180. in
    Ok (metres *. cos course, metres *. sin course, 0.)
  | x -> wrong s no_point x

let follow_path s (m : Plan.maneuver) =
  match List.assoc_opt "points" s.named with
  | None | Some (List [||]) -> fault s "followPath lacks its points, as in points:[[0, 0], [100, 50]]"
  | Some (List points) ->
    let* points = each (point s m.location) (Array.to_list points) in
    Ok { m with kind = Follow_path points }
  | Some x -> wrong s no_point x

(* The setting, the IMC message that identifiers are made from, the arguments besides the common ones. *)
let maneuvers =
  [ ("goTo", ("Goto", [], go_to));
    ("loiter", ("Loiter", [ "radius"; "duration"; "direction" ], loiter));
    ("yoyo", ("YoYo", [ "max_depth"; "min_depth"; "pitch" ], yo_yo));
    ("popup", ("PopUp", [ "duration"; "currPos"; "waitAtSurface"; "stationKeep" ], pop_up));
    ("skeeping", ("StationKeeping", [ "radius"; "duration" ], station_keeping));
    ( "compassCalibration",
      ( "CompassCalibration",
        [ "amplitude"; "radius"; "pitch"; "duration"; "direction" ],
        compass_calibration ) );
    ("launch", ("Launch", [], launch));
    ( "rows",
      ( "Rows",
        [ "bearing"; "cross_angle"; "width"; "length"; "hstep"; "coff"; "curvOff"; "alternation"; "squareCurve";
          "firstCurveRight" ],
        rows ) );
    ("followPath", ("FollowPath", [ "points" ], follow_path)) ]

let common = [ "speed"; "z"; "location"; "id"; "payload" ]

(* {1 Plans} *)

type draft = {
  name : string;
  description : string;
  vehicles : string list;
  location : Position.t;
  speed : float * Plan.speed_unit;
  speed_unit : Plan.speed_unit;  (* of speeds that name none *)
  z : float * Plan.z_unit;
  reserved : string list;  (* identifiers that the program gives *)
  latest_first : Plan.maneuver list;
}

let empty name reserved =
  {
    name;
    description = "";
    vehicles = [];
    location = Dolphin_geo.Place.apdl;
    speed = (900., Revolutions_per_minute);
    speed_unit = Metres_per_second;
    z = (2., Depth);
    reserved;
    latest_first = [];
  }

let set_speed s xs draft =
  let* value, unit = speed draft.speed_unit s xs in
  Ok { draft with speed = (value, unit); speed_unit = unit }

let set_z s xs draft =
  let* z = z (snd draft.z) s xs in
  Ok { draft with z }

(* A speed, a z or a location that one maneuver names holds for those after it too. *)
let set_common s draft =
  let named name set draft =
    match List.assoc_opt name s.named with None -> Ok draft | Some x -> set x draft
  in
  let locate x draft =
    let* location = position s ("as location of " ^ s.setting) x in
    Ok { draft with location }
  in
  let* draft = named "speed" (fun x -> set_speed s [ x ]) draft in
  let* draft = named "z" (fun x -> set_z s [ x ]) draft in
  named "location" locate draft

let identifier s message draft =
  match List.assoc_opt "id" s.named with
  | Some x ->
    let* id = string s ("id of " ^ s.setting) x in
    if List.exists (fun (m : Plan.maneuver) -> m.id = id) draft.latest_first then
      fault s "another maneuver of the plan has the id '%s'" id
    else Ok id
  | None ->
    let first = Printf.sprintf "%d.%s" (List.length draft.latest_first + 1) message in
    let rec free id n = if List.mem id draft.reserved then free (Printf.sprintf "%s.%d" first n) (n + 1) else id in
    Ok (free first 2)

let check_named s known =
  let rec check = function
    | [] -> Ok ()
    | (name, _) :: _ when not (List.mem name known) ->
      if known = [] then fault s "%s takes no named arguments, such as '%s'" s.setting name
      else fault s "%s has no argument '%s': %s" s.setting name (instead name known ~otherwise:"it takes")
    | (name, _) :: rest when List.mem_assoc name rest -> fault s "%s has its argument '%s' twice" s.setting name
    | _ :: rest -> check rest
  in
  check s.named

(* [goTo([speed: 2])] is [goTo speed: 2]. *)
let arguments s =
  match s.positional with
  | [ Map entries ] -> { s with positional = []; named = s.named @ entries }
  | _ -> s

let add_maneuver (message, own, read) s draft =
  let s = arguments s in
  let* () = check_named s (own @ common) in
  if s.positional <> [] then fault s "%s takes only named arguments, as in %s speed:1.5" s.setting s.setting
  else
    let* draft = set_common s draft in
    let* id = identifier s message draft in
    let* payloads = argument s "payload" ~default:[] devices in
    let { location; speed; z; _ } = draft in
    let* m = read s { Plan.id; kind = Go_to; location; speed; z; payloads } in
    Ok { draft with latest_first = m :: draft.latest_first }

let plan_name s draft =
  match s.positional with
  | [ x ] ->
    let* name = string s "planName" x in
    Ok { draft with name }
  | [] | _ :: _ -> fault s "planName takes one string"

let description s draft =
  match s.positional with
  | [ String description ] -> Ok { draft with description }
  | [ x ] -> wrong s "a string as description" x
  | [] | _ :: _ -> fault s "description takes one string"

let vehicles s draft =
  let rec name = function
    | String _ as x ->
      let* name = string s "a vehicle's name" x in
      Ok [ name ]
    | Vehicles vs -> Ok vs
    | List xs -> all (Array.to_list xs)
    | x -> wrong s "names of vehicles, as in vehicles 'lauv-noptilus-1', 'lauv-noptilus-2'" x
  and all xs = Result.map List.concat (each name xs) in
  let once names name = if List.mem name names then names else name :: names in
  let* names = all s.positional in
  if names = [] then fault s "vehicles lacks the names of vehicles"
  else Ok { draft with vehicles = List.rev (List.fold_left once [] names) }

let locate s draft =
  let* location =
    match s.positional with
    | [ latitude; longitude ] -> coordinates s latitude longitude
    | [ x ] -> position s "after locate" x
    | [] | _ :: _ -> fault s "locate takes a position, or latitude and longitude in degrees"
  in
  Ok { draft with location }

let widest_move = 20_000_000.

let move s draft =
  let metres = within (-.widest_move) widest_move " m" s in
  match s.positional with
  | [ north; east ] ->
    let* north = metres "move to the north" north in
    let* east = metres "move to the east" east in
    Ok { draft with location = Wgs84.displace draft.location ~north ~east }
  | [] | _ :: _ -> fault s "move takes two numbers: metres to the north and metres to the east"

let settings =
  [ ("planName", plan_name); ("description", description); ("vehicles", vehicles);
    ("speed", fun s -> set_speed s s.positional);
    ("z", fun s -> set_z s s.positional);
    ("locate", locate); ("move", move) ]

let vocabulary =
  List.map (fun (name, _) -> (name, [])) settings
  @ List.map (fun (name, (_, own, _)) -> (name, own @ common)) maneuvers

let add draft s =
  let* draft = draft in
  match List.assoc_opt s.setting settings, List.assoc_opt s.setting maneuvers with
  | Some set, _ ->
    let* () = check_named s [] in
    set s draft
  | None, Some maneuver -> add_maneuver maneuver s draft
  | None, None ->
    fault s "an inline plan has no setting '%s': %s" s.setting
      (instead s.setting (List.map fst vocabulary) ~otherwise:"it has")

let given_id s =
  match List.assoc_opt "id" (arguments s).named with
  | Some (String id) -> Some id
  | Some _ | None -> None

let build ~name site settings =
  let reserved = List.filter_map given_id settings in
  let* draft = List.fold_left add (Ok (empty name reserved)) settings in
  match List.rev draft.latest_first with
  | [] -> Error (Fault.make site (Printf.sprintf "plan '%s' has no maneuver, such as goTo or loiter" draft.name))
  | maneuvers ->
    Ok { Plan.name = draft.name; description = draft.description; vehicles = draft.vehicles; maneuvers }
