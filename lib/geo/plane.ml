open Angle

type t = Position.t

type point = float * float

let around (p : Position.t) = { p with height = 0. }
let origin p = p
let reach = 200_000.

let of_position origin p =
  let metres = Wgs84.distance origin p and course = radians (Wgs84.bearing origin p) in
  (metres *. sin course, metres *. cos course)

let billionths x = Float.round (x *. 1e9) /. 1e9

let to_position origin (east, north) =
  let p = Wgs84.displace origin ~north ~east in
  let longitude = billionths p.longitude in
  let longitude = if longitude <= -180. then 180. else longitude in
  { Position.latitude = billionths p.latitude; longitude; height = 0. }

let unit (p : Position.t) =
  let latitude = radians p.latitude and longitude = radians p.longitude in
  (cos latitude *. cos longitude, cos latitude *. sin longitude, sin latitude)

let millionths x = Float.round (x *. 1e6) /. 1e6

let between positions =
  let add (x, y, z) p =
    let x', y', z' = unit p in
    (x +. x', y +. y', z +. z')
  in
  let x, y, z = List.fold_left add (0., 0., 0.) positions in
  if positions = [] || Float.hypot (Float.hypot x y) z < 0.5 *. float_of_int (List.length positions) then None
  else
    let latitude = millionths (degrees (atan2 z (Float.hypot x y))) and longitude = millionths (degrees (atan2 y x)) in
    let middle = { Position.latitude; longitude; height = 0. } in
    if List.for_all (fun p -> Wgs84.distance middle p <= reach) positions then Some middle else None

(* The geometric mean of the two radii of curvature. *)
let earth_radius (p : Position.t) =
  let flattening = 1. /. 298.257223563 in
  let square = flattening *. (2. -. flattening) in
  let sine = sin (radians p.latitude) in
  6_378_137. *. sqrt (1. -. square) /. (1. -. (square *. sine *. sine))
