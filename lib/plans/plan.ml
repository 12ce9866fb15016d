type speed_unit = Metres_per_second | Revolutions_per_minute | Percent
type z_unit = Depth | Altitude | Height | Unspecified
type direction = Vehicle_dependent | Clockwise | Counter_clockwise | Into_wind_or_current
type payload = { name : string; parameters : (string * string) list }

type kind =
  | Go_to
  | Loiter of { radius : float; duration : float; direction : direction }
  | Yo_yo of { amplitude : float; pitch : float }
  | Pop_up of { duration : float; current_position : bool; wait_at_surface : bool; station_keep : bool }
  | Station_keeping of { radius : float; duration : float }
  | Compass_calibration of {
      amplitude : float;
      radius : float;
      pitch : float;
      duration : float;
      direction : direction;
    }
  | Launch
  | Rows of {
      bearing : float;
      cross_angle : float;
      width : float;
      length : float;
      horizontal_step : float;
      curve_offset : float;
      alternation : float;
      square_curve : bool;
      first_curve_right : bool;
    }
  | Follow_path of (float * float * float) list

type maneuver = {
  id : string;
  kind : kind;
  location : Dolphin_geo.Position.t;
  speed : float * speed_unit;
  z : float * z_unit;
  payloads : payload list;
}

type t = { name : string; description : string; vehicles : string list; maneuvers : maneuver list }

let required_payload p =
  let add names name = if List.mem name names then names else name :: names in
  let of_maneuver names m = List.fold_left (fun names (d : payload) -> add names d.name) names m.payloads in
  List.rev (List.fold_left of_maneuver [] p.maneuvers)

let is_done_anywhere m =
  match m.kind with
  | Pop_up { current_position; _ } -> current_position
  | Go_to | Loiter _ | Yo_yo _ | Station_keeping _ | Compass_calibration _ | Launch | Rows _ | Follow_path _ -> false

let reference p =
  Option.map (fun m -> m.location) (List.find_opt (fun m -> not (is_done_anywhere m)) p.maneuvers)

(* {1 The way} *)

type level = { measured_from : z_unit; stays_at : float; amplitude : float; pitch : float }

type leg = {
  maneuver : string;
  waypoints : Dolphin_geo.Position.t list;
  level : level;
  dwell : float;
  radius : float;
}

(* Metres above the ellipsoid, [down] below the maneuver's [z]. *)
let height (m : maneuver) down =
  match m.z with
  | z, Depth -> 0. -. (z +. down)
  | z, Height -> z -. down
  | z, Altitude -> m.location.height +. z -. down
  | _, Unspecified -> m.location.height

let level (m : maneuver) =
  let at_z = { measured_from = snd m.z; stays_at = height m 0.; amplitude = 0.; pitch = 0. } in
  match m.kind with
  | Yo_yo { amplitude; pitch } -> { at_z with amplitude = amplitude /. 2.; pitch }
  | Compass_calibration { amplitude; pitch; _ } -> { at_z with amplitude; pitch }
  | Pop_up _ -> { at_z with measured_from = Depth; stays_at = 0. }
  | Go_to | Loiter _ | Station_keeping _ | Launch | Rows _ | Follow_path _ -> at_z

(* How the rows run: metres ahead of the start (along the bearing) and metres to the right of it. The first point lies
   [offset] before the start, so that the vehicle is on course when it gets there; each row runs on for [offset] too.
   At the far end a vehicle shifts sideways by [share] steps, at the near end by [2 - share], so that two shifts are
   two steps. A square curve shifts first and then comes back; another does both on a diagonal. *)
let offsets_of_rows ~length ~offset ~step ~share ~curves ~cross_angle ~square ~right =
  let sideways = if right then 1. else -1. in
  let rec row ahead (x, y) curves points =
    let forward = if ahead then 1. else -1. in
    let x = x +. (forward *. (length +. offset)) in
    let points = (x, y) :: points in
    let share = if ahead then share else 2. -. share in
    if share > 0. && curves <= 0 then List.rev points
    else
      let shift = share *. step in
      let x = x -. (shift *. sin cross_angle) and y = y +. (sideways *. shift *. cos cross_angle) in
      let next = (x -. (forward *. offset), y) in
      let points = if square then next :: (x, y) :: points else next :: points in
      row (not ahead) next (if share > 0. then curves - 1 else curves) points
  in
  row true (0., 0.) curves [ (0., 0.); (-.offset, 0.) ]

let turned bearing (x, y) =
  let sine = sin bearing and cosine = cos bearing in
  ((x *. cosine) -. (y *. sine), (x *. sine) +. (y *. cosine))

let unending seconds = if seconds > 0. then seconds else infinity

let leg (m : maneuver) =
  let place down = Dolphin_geo.Position.at_height (height m down) m.location in
  let along waypoints dwell = { maneuver = m.id; waypoints; level = level m; dwell; radius = 0. } in
  let at_location = along [ place 0. ] in
  let through offsets =
    let waypoint (north, east, down) = Dolphin_geo.Wgs84.displace (place down) ~north ~east in
    along (List.rev (List.rev_map waypoint offsets)) 0.
  in
  match m.kind with
  | Go_to | Yo_yo _ | Launch -> at_location 0.
  | Loiter { radius; duration; _ } | Station_keeping { radius; duration }
  | Compass_calibration { radius; duration; _ } ->
    { (at_location (unending duration)) with radius }
  | Pop_up { duration; current_position; wait_at_surface; station_keep } ->
    (* Without reason to stay, a vehicle dives again as soon as it has a fix. *)
    let dwell = if wait_at_surface || station_keep then duration else 0. in
    if current_position then along [] dwell else at_location dwell
  | Follow_path points -> through points
  | Rows r ->
    let step = r.horizontal_step in
    let curves = if step > 0. then int_of_float (r.width /. step) else 0 in
    offsets_of_rows ~length:r.length ~offset:r.curve_offset ~step ~share:(r.alternation /. 100.) ~curves
      ~cross_angle:(Dolphin_geo.Angle.radians r.cross_angle) ~square:r.square_curve ~right:r.first_curve_right
    |> List.rev_map (fun offset ->
        let north, east = turned (Dolphin_geo.Angle.radians r.bearing) offset in
        (north, east, 0.))
    |> List.rev |> through

let path p = List.map leg p.maneuvers

let metres_per_second (m : maneuver) ~default =
  match m.speed with
  | metres, Metres_per_second -> metres
  | _, (Revolutions_per_minute | Percent) -> default

(* Plans are plain data without functions or cycles. *)
let compare (a : t) (b : t) = Stdlib.compare a b

let pp ppf p =
  Format.fprintf ppf "%s: %a" p.name
    Fmt.(list ~sep:(any ", ") string)
    (List.map (fun (m : maneuver) -> m.id) p.maneuvers)
