open Dolphin_plans
open Dolphin_imc
open Dolphin_geo.Angle

let timeout = 65535
let pop_up_radius = 20.
let whole x = int_of_float (Float.round x)

let speed_units : Plan.speed_unit -> Message.Speed_units.t = function
  | Metres_per_second -> Meters_ps
  | Revolutions_per_minute -> Rpm
  | Percent -> Percentage

let z_units : Plan.z_unit -> Message.Z_units.t = function
  | Depth -> Depth
  | Altitude -> Altitude
  | Height -> Height
  | Unspecified -> None

let loiter_direction : Plan.direction -> Message.Loiter.Direction.t = function
  | Vehicle_dependent -> Vdep
  | Clockwise -> Clockw
  | Counter_clockwise -> Cclockw
  | Into_wind_or_current -> Iwindcurr

let calibration_direction : Plan.direction -> Message.Compass_calibration.Direction.t = function
  | Vehicle_dependent -> Vdep
  | Clockwise -> Clockw
  | Counter_clockwise -> Cclockw
  | Into_wind_or_current -> Iwindcurr

let maneuver (m : Plan.maneuver) : Message.Maneuver.t =
  let lat = radians m.location.latitude and lon = radians m.location.longitude in
  let speed, speed_units = (fst m.speed, speed_units (snd m.speed)) in
  let z, z_units = (fst m.z, z_units (snd m.z)) in
  match m.kind with
  | Go_to -> Goto { Message.Goto.default with timeout; lat; lon; z; z_units; speed; speed_units }
  | Launch -> Launch { Message.Launch.default with timeout; lat; lon; z; z_units; speed; speed_units }
  | Loiter { radius; duration; direction } ->
    Loiter
      { Message.Loiter.default with
        timeout; lat; lon; z; z_units; speed; speed_units; radius; duration = whole duration; type_ = Circular;
        direction = loiter_direction direction }
  | Yo_yo { amplitude; pitch } ->
    Yo_yo
      { Message.Yo_yo.default with
        timeout; lat; lon; z; z_units; speed; speed_units; amplitude = amplitude /. 2.; pitch = radians pitch }
  | Pop_up { duration; current_position; wait_at_surface; station_keep } ->
    let flag set bit = if set then bit else Message.Pop_up.Flags.none in
    let place = flag current_position Message.Pop_up.Flags.curr_pos in
    let wait = flag wait_at_surface Message.Pop_up.Flags.wait_at_surface in
    let keep = flag station_keep Message.Pop_up.Flags.station_keep in
    let flags = Message.Pop_up.Flags.(place + wait + keep) in
    Pop_up
      { Message.Pop_up.default with
        timeout; lat; lon; z; z_units; speed; speed_units; duration = whole duration; radius = pop_up_radius; flags }
  | Station_keeping { radius; duration } ->
    Station_keeping
      { Message.Station_keeping.default with
        lat; lon; z; z_units; speed; speed_units; radius; duration = whole duration }
  | Compass_calibration { amplitude; radius; pitch; duration; direction } ->
    Compass_calibration
      { Message.Compass_calibration.default with
        timeout; lat; lon; z; z_units; speed; speed_units; amplitude; radius; pitch = radians pitch;
        duration = whole duration; direction = calibration_direction direction }
  | Rows r ->
    let open Message.Rows in
    let flag set bit = if set then bit else Flags.none in
    Rows
      { default with
        timeout; lat; lon; z; z_units; speed; speed_units; bearing = radians r.bearing;
        cross_angle = radians r.cross_angle; width = r.width; length = r.length; hstep = r.horizontal_step;
        coff = whole r.curve_offset; alternation = whole r.alternation;
        flags = Flags.(flag r.square_curve square_curve + flag r.first_curve_right curve_right) }
  | Follow_path points ->
    let point (x, y, z) = { Message.Path_point.x; y; z } in
    Follow_path
      { Message.Follow_path.default with
        timeout; lat; lon; z; z_units; speed; speed_units; points = List.map point points }

let action (d : Plan.payload) : Message.t =
  let parameter (name, value) = { Message.Entity_parameter.name; value } in
  Set_entity_parameters { name = d.name; params = List.map parameter d.parameters }

let of_plan (p : Plan.t) : Message.t Message.Plan_specification.t =
  let plan_maneuver (m : Plan.maneuver) =
    { Message.Plan_maneuver.default with
      maneuver_id = m.id; data = Some (maneuver m); start_actions = List.map action m.payloads }
  in
  let transition (a : Plan.maneuver) (b : Plan.maneuver) =
    { Message.Plan_transition.default with source_man = a.id; dest_man = b.id; conditions = "maneuverIsDone" }
  in
  let rec transitions = function
    | a :: (b :: _ as rest) -> transition a b :: transitions rest
    | [ _ ] | [] -> []
  in
  let start_man_id = match p.maneuvers with first :: _ -> first.id | [] -> "" in
  { Message.Plan_specification.default with
    plan_id = p.name; description = p.description; start_man_id;
    maneuvers = List.map plan_maneuver p.maneuvers;
    transitions = transitions p.maneuvers }
