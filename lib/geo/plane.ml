open Angle

type t = Position.t

type point = float * float

let around (p : Position.t) = { p with height = 0. }
let origin p = p
let reach = 200_000.

let of_position origin p =
  let north, east = Wgs84.displacement origin p in
  (east, north)

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

(* Between unit vectors: some 185 km, so that most positions need no geodesic. *)
let surely = 0.029

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
    let x, y, z = unit middle in
    let is_within p =
      let x', y', z' = unit p in
      Float.hypot (Float.hypot (x -. x') (y -. y')) (z -. z') < surely || Wgs84.distance middle p <= reach
    in
    if List.for_all is_within positions then Some middle else None

(* The geometric mean of the two radii of curvature. *)
let earth_radius (p : Position.t) =
  let flattening = 1. /. 298.257223563 in
  let square = flattening *. (2. -. flattening) in
  let sine = sin (radians p.latitude) in
  6_378_137. *. sqrt (1. -. square) /. (1. -. (square *. sine *. sine))
