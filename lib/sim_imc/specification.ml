open Dolphin_imc
open Dolphin_plans
open Dolphin_geo.Angle

type t = { plan : Plan.t; kinds : int list }

let deepest = 100.
let ( let* ) = Result.bind
let fault id why = Error (Printf.sprintf "parse error: %s: %s" id why)

(* {1 One maneuver} *)

let speed_unit : Message.Speed_units.t -> Plan.speed_unit = function
  | Meters_ps -> Metres_per_second
  | Rpm -> Revolutions_per_minute
  | Percentage | Other _ -> Percent

let z_unit : Message.Z_units.t -> Plan.z_unit = function
  | Depth -> Depth
  | Altitude -> Altitude
  | Height -> Height
  | None | Other _ -> Unspecified

(* The common fields of maneuvers that go somewhere. *)
type common = {
  lat : float;
  lon : float;
  z : float * Message.Z_units.t;
  speed : float * Message.Speed_units.t;
}

let seconds n = float_of_int n

let rows (r : Message.Rows.t) : Plan.kind =
  Rows
    { bearing = degrees r.bearing; cross_angle = degrees r.cross_angle; width = r.width; length = r.length;
      horizontal_step = r.hstep; curve_offset = float_of_int r.coff; alternation = float_of_int r.alternation;
      square_curve = Message.Rows.Flags.(mem square_curve r.flags);
      first_curve_right = Message.Rows.Flags.(mem curve_right r.flags) }

let pop_up (p : Message.Pop_up.t) : Plan.kind =
  let set flag = Message.Pop_up.Flags.mem flag p.flags in
  Pop_up
    { duration = seconds p.duration; current_position = set Message.Pop_up.Flags.curr_pos;
      wait_at_surface = set Message.Pop_up.Flags.wait_at_surface; station_keep = set Message.Pop_up.Flags.station_keep }

let follow_path (p : Message.Follow_path.t) : Plan.kind =
  Follow_path (List.rev (List.rev_map (fun (p : Message.Path_point.t) -> p.x, p.y, p.z) p.points))

(* The way round is left out of paths: any direction will do. *)
let content (m : Message.Maneuver.t) : (common * Plan.kind) option =
  let common lat lon z z_units speed speed_units = { lat; lon; z = (z, z_units); speed = (speed, speed_units) } in
  match m with
  | Goto m -> Some (common m.lat m.lon m.z m.z_units m.speed m.speed_units, Go_to)
  | Launch m -> Some (common m.lat m.lon m.z m.z_units m.speed m.speed_units, Launch)
  | Rows m -> Some (common m.lat m.lon m.z m.z_units m.speed m.speed_units, rows m)
  | Pop_up m -> Some (common m.lat m.lon m.z m.z_units m.speed m.speed_units, pop_up m)
  | Follow_path m -> Some (common m.lat m.lon m.z m.z_units m.speed m.speed_units, follow_path m)
  | Loiter m ->
    let kind = Plan.Loiter { radius = m.radius; duration = seconds m.duration; direction = Vehicle_dependent } in
    Some (common m.lat m.lon m.z m.z_units m.speed m.speed_units, kind)
  | Yo_yo m ->
    let kind = Plan.Yo_yo { amplitude = 2. *. m.amplitude; pitch = degrees m.pitch } in
    Some (common m.lat m.lon m.z m.z_units m.speed m.speed_units, kind)
  | Station_keeping m ->
    let kind = Plan.Station_keeping { radius = m.radius; duration = seconds m.duration } in
    Some (common m.lat m.lon m.z m.z_units m.speed m.speed_units, kind)
  | Compass_calibration m ->
    let kind =
      Plan.Compass_calibration
        { amplitude = m.amplitude; radius = m.radius; pitch = degrees m.pitch; duration = seconds m.duration;
          direction = Vehicle_dependent }
    in
    Some (common m.lat m.lon m.z m.z_units m.speed m.speed_units, kind)
  | Teleoperation _ | Idle_maneuver _ | Low_level_control _ | Elevator _ | Follow_trajectory _ | Custom_maneuver _
  | Vehicle_formation _ | Comms_relay _ | Cover_area _ | Formation_plan_execution _ | Follow_reference _ | Dislodge _
  | Drop _ | Scheduled_goto _ | Rows_coverage _ | Sample _ | Image_tracking | Takeoff _ | Land _
  | Autonomous_section _ | Follow_point _ | Alignment _ | Station_keeping_extended _ | Magnetometer _ -> None

(* Numbers from the network may be anything; these keep the way finite. *)
let longest_way = 1e7
let most_curves = 10_000.
let is_length x = Float.abs x <= longest_way

let is_feasible : Plan.kind -> bool = function
  | Rows r ->
    let curves = if r.horizontal_step > 0. then r.width /. r.horizontal_step else 0. in
    is_length r.width && is_length r.length && is_length r.horizontal_step && curves <= most_curves
    && Float.is_finite r.bearing && Float.is_finite r.cross_angle
  | Follow_path points -> List.for_all (fun (x, y, _) -> is_length x && is_length y) points
  | Go_to | Loiter _ | Yo_yo _ | Pop_up _ | Station_keeping _ | Compass_calibration _ | Launch -> true

let maneuver (m : Message.t Message.Plan_maneuver.t) : (Plan.maneuver * int, string) result =
  let id = m.maneuver_id in
  let* data = match m.data with Some data -> Ok data | None -> fault id "actual maneuver not specified" in
  let* common, kind = match content data with Some x -> Ok x | None -> fault id "maneuver is not supported" in
  let* location =
    let latitude = degrees common.lat and longitude = degrees common.lon in
    match Dolphin_geo.Position.make ~latitude ~longitude ~height:0. with
    | Ok location -> Ok location
    | Error _ -> fault id "maneuver has invalid coordinates"
  in
  if not (is_feasible kind) then fault id "maneuver has invalid parameters"
  else if snd common.z = Depth && not (fst common.z <= deepest) then fault id "maneuver depth beyond limits"
  else
    let speed = fst common.speed, speed_unit (snd common.speed) and z = fst common.z, z_unit (snd common.z) in
    Ok ({ Plan.id; kind; location; speed; z; payloads = [] }, Message.id (Maneuver data))

(* {1 The order} *)

module String_map = Map.Make (String)
module String_set = Set.Make (String)

let check_reachable (s : Message.t Message.Plan_specification.t) =
  let reached =
    List.fold_left
      (fun set (t : _ Message.Plan_transition.t) -> String_set.add t.dest_man set)
      (String_set.singleton s.start_man_id) s.transitions
  in
  let lost (m : _ Message.Plan_maneuver.t) = not (String_set.mem m.maneuver_id reached) in
  match List.find_opt lost s.maneuvers with
  | Some m -> fault m.maneuver_id "has no incoming transition and it's not the initial maneuver"
  | None -> Ok ()

let add_first key x map = if String_map.mem key map then map else String_map.add key x map

let station_keeping (m : Plan.maneuver) =
  { m with kind = Station_keeping { radius = 0.; duration = 0. } }, Message.Station_keeping.id

(* The maneuvers on the way from [id], latest first, after those in [visited]. *)
let rec along maneuvers next id visited found =
  match String_map.find_opt id maneuvers with
  | None -> Error (Printf.sprintf "parse error: maneuver %s is not defined" id)
  | Some m when String_set.mem id visited ->
    let* m, _ = maneuver m in
    Ok (station_keeping m :: found)
  | Some m -> (
      let* m = maneuver m in
      let found = m :: found in
      match String_map.find_opt id next with
      | None | Some "_done_" -> Ok found
      | Some id' -> along maneuvers next id' (String_set.add id visited) found)

let read (s : Message.t Message.Plan_specification.t) =
  let add_maneuver map (m : _ Message.Plan_maneuver.t) = add_first m.maneuver_id m map in
  let add_transition map (t : _ Message.Plan_transition.t) = add_first t.source_man t.dest_man map in
  let maneuvers = List.fold_left add_maneuver String_map.empty s.maneuvers in
  let next = List.fold_left add_transition String_map.empty s.transitions in
  let* () = check_reachable s in
  let* found = along maneuvers next s.start_man_id String_set.empty [] in
  let maneuvers, kinds = List.split (List.rev found) in
  Ok { plan = { name = s.plan_id; description = s.description; vehicles = []; maneuvers }; kinds }

let of_maneuver ~plan m : Message.t Message.Plan_specification.t =
  { Message.Plan_specification.default with
    plan_id = plan; start_man_id = "1";
    maneuvers = [ { Message.Plan_maneuver.default with maneuver_id = "1"; data = Some m } ] }
