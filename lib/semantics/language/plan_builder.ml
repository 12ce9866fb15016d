open Dolphin_plans
open Dolphin_results
open Core
open Plan_values
module Position = Dolphin_geo.Position
module Wgs84 = Dolphin_geo.Wgs84

let ( let* ) = Result.bind

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
  | None -> fault s "'%s' is not a %s: %s" text what (instead text (List.map fst directions) ~otherwise:"there are")

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
  | List xs as x -> (
      match Vector.to_list xs with
      | [ north; east ] -> point_of_map s [ ("north", north); ("east", east) ]
      | [ north; east; down ] -> point_of_map s [ ("north", north); ("east", east); ("down", down) ]
      | [] | _ :: _ -> wrong s no_point x)
  | Map entries -> point_of_map s entries
  | Position p ->
    let* metres = within 0. longest " m" s "the distance of a point" (Number (Wgs84.distance origin p)) in
    let course = Dolphin_geo.Angle.radians (Wgs84.bearing origin p) in
    Ok (metres *. cos course, metres *. sin course, 0.)
  | x -> wrong s no_point x

let follow_path s (m : Plan.maneuver) =
  match List.assoc_opt "points" s.named with
  | Some (List points) when Vector.length points > 0 ->
    let* points = Results.map (point s m.location) (Vector.to_list points) in
    Ok { m with kind = Follow_path points }
  | None | Some (List _) -> fault s "followPath lacks its points, as in points:[[0, 0], [100, 50]]"
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

let hint_for_place =
  "write locate LATITUDE, LONGITUDE before it, or once for all plans at the top of the program or in its fleet"

type draft = {
  name : string;
  description : string;
  vehicles : string list;
  location : Position.t option;
  speed : float * Plan.speed_unit;
  speed_unit : Plan.speed_unit;  (* of speeds that name none *)
  z : float * Plan.z_unit;
  reserved : string list;  (* identifiers that the program gives *)
  latest_first : Plan.maneuver list;
}

let empty name ~place reserved =
  {
    name;
    description = "";
    vehicles = [];
    location = place;
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
    Ok { draft with location = Some location }
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

let no_place name = Printf.sprintf "'%s' has no place: neither plan, program nor fleet has one" name
let lacks_place s = fault s "%s; %s" (no_place s.setting) hint_for_place

(* The location of a maneuver at the vehicle's position is ignored. *)
let nowhere : Position.t = { latitude = 0.; longitude = 0.; height = 0. }

let is_done_anywhere s =
  s.setting = "popup"
  && match List.assoc_opt "currPos" s.named with Some (Boolean false) -> false | Some _ | None -> true

let add_maneuver (message, own, read) s draft =
  let s = arguments s in
  let* () = check_named s (own @ common) in
  if s.positional <> [] then fault s "%s takes only named arguments, as in %s speed:1.5" s.setting s.setting
  else
    let* draft = set_common s draft in
    let* id = identifier s message draft in
    let* payloads = argument s "payload" ~default:[] devices in
    let* location =
      match draft.location with
      | Some location -> Ok location
      | None -> if is_done_anywhere s then Ok nowhere else lacks_place s
    in
    let { speed; z; _ } = draft in
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

let vehicles s draft = Result.map (fun vehicles -> { draft with vehicles }) (vehicle_names s)

let located s =
  match s.positional with
  | [ latitude; longitude ] -> coordinates s latitude longitude
  | [ x ] -> position s "after locate" x
  | [] | _ :: _ -> fault s "locate takes a position, or latitude and longitude in degrees"

let locate s draft = Result.map (fun location -> { draft with location = Some location }) (located s)

let move s draft =
  let metres = within (-.Wgs84.farthest) Wgs84.farthest " m" s in
  match s.positional with
  | [ north; east ] ->
    let* north = metres "move to the north" north in
    let* east = metres "move to the east" east in
    (match draft.location with
     | Some from -> Ok { draft with location = Some (Wgs84.displace from ~north ~east) }
     | None -> lacks_place s)
  | [] | _ :: _ -> fault s "move takes two numbers: metres to the north and metres to the east"

let settings =
  [ ("planName", plan_name); ("description", description); ("vehicles", vehicles);
    ("speed", fun s -> set_speed s s.positional);
    ("z", fun s -> set_z s s.positional);
    ("locate", locate); ("move", move) ]

let units = Plan_values.units

let vocabulary =
  List.map (fun (name, _) -> (name, [])) settings
  @ List.map (fun (name, (_, own, _)) -> (name, own @ common)) maneuvers

let add draft s =
  match List.assoc_opt s.setting settings, List.assoc_opt s.setting maneuvers with
  | Some set, _ ->
    let* () = check_named s [] in
    set s draft
  | None, Some maneuver -> add_maneuver maneuver s draft
  | None, None ->
    fault s "an inline plan has no setting '%s': %s" s.setting
      (instead s.setting (List.map fst vocabulary) ~otherwise:"it has")

let is_maneuver name = List.mem_assoc name maneuvers

let given_id s =
  match List.assoc_opt "id" (arguments s).named with
  | Some (String id) -> Some id
  | Some _ | None -> None

let build ~name ~place site settings =
  let reserved = List.filter_map given_id settings in
  let* draft = Results.fold add (empty name ~place reserved) settings in
  match List.rev draft.latest_first with
  | [] -> Error (Fault.make site (Printf.sprintf "plan '%s' has no maneuver, such as goTo or loiter" draft.name))
  | maneuvers ->
    Ok { Plan.name = draft.name; description = draft.description; vehicles = draft.vehicles; maneuvers }
