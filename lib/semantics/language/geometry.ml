open Dolphin_results
open Core
module Coverage = Dolphin_geo.Coverage
module Search_pattern = Dolphin_geo.Search_pattern

let ( let* ) = Result.bind

let number what x =
  match Value.to_number x with
  | Some n when Float.is_finite n -> Ok n
  | Some _ -> Error (Printf.sprintf "expected %s, found no finite number" what)
  | None -> Operators.expected what x

let position what = function Position p -> Ok p | x -> Operators.expected what x

let positions what = function
  | List xs -> Results.map (position ("a position in " ^ what)) (Vector.to_list xs)
  | x -> Operators.expected (Printf.sprintf "%s, a list of positions" what) x

let along path metres =
  let* path = positions "a path" path in
  let* metres = number "metres along a path" metres in
  match Dolphin_geo.Wgs84.along path metres with
  | Some p -> Ok (Position p)
  | None -> Error "a path without positions leads nowhere"

let polygon corners holes =
  let* corners = positions "the corners of a polygon" corners in
  let* holes =
    match holes with
    | None -> Ok []
    | Some (List holes) -> Results.map (positions "a hole") (Vector.to_list holes)
    | Some x -> Operators.expected "holes, a list of lists of positions" x
  in
  Operators.area (Dolphin_geo.Area.polygon ~holes corners)

let corridor path width =
  let* path = positions "a path" path in
  let* width = number "a width in metres" width in
  Operators.area (Dolphin_geo.Area.corridor path width)

let area what = function Area a -> Ok a | x -> Operators.expected what x

let named name named =
  match List.assoc_opt name named with
  | None -> Ok None
  | Some x -> Result.map Option.some (number (Printf.sprintf "a number for %s" name) x)

let or_lacking what name = Option.to_result ~none:(Printf.sprintf "%s lacks its argument '%s'" what name)

let positions_value ps = List (Vector.of_list (List.map (fun p -> Position p) ps))

let coverage whole arguments =
  let* whole = area "an area to cover" whole in
  let number name = named name arguments in
  let* spacing = number "spacing" in
  let* spacing = or_lacking "coverage" "spacing" spacing in
  let* bearing = number "bearing" in
  let* overlap = number "overlap" in
  let* turn = number "turn" in
  let or_zero = Option.value ~default:0. in
  let settings = { Coverage.spacing; bearing; overlap = or_zero overlap; turn = or_zero turn } in
  let points = Result.map positions_value (Coverage.points settings whole) in
  Result.map_error (Format.asprintf "%a" Coverage.pp_error) points

let search name datum arguments =
  let* datum = position "a position to search around" datum in
  let number name = named name arguments in
  let needed k x = or_lacking name k x in
  let* spacing = number "spacing" in
  let* radius = number "radius" in
  let* radius = needed "radius" radius in
  let* bearing = number "bearing" in
  let bearing = Option.value bearing ~default:0. in
  let* found =
    if name = "sector" then Ok (Search_pattern.sector datum ~radius ~bearing)
    else
      let* spacing = needed "spacing" spacing in
      let make = if name = "spiral" then Search_pattern.spiral else Search_pattern.expanding_square in
      Ok (make datum ~spacing ~radius ~bearing)
  in
  Result.map_error (Format.asprintf "%a" Search_pattern.pp_error) (Result.map positions_value found)

(* How wide the ground is that a device sees: [range] is that of a sidescan to either side, [angle] is how wide a camera
   or another sonar sees. *)
let footprint arguments =
  let number name = named name arguments in
  let* altitude = number "altitude" in
  let* altitude = or_lacking "footprint" "altitude" altitude in
  let* range = number "range" in
  let* angle = number "angle" in
  if not (altitude > 0.) then Error (Printf.sprintf "an altitude is above 0 m, not %g" altitude)
  else
    match range, angle with
    | Some range, None when range > altitude ->
      Ok (Number (2. *. sqrt ((range *. range) -. (altitude *. altitude))))
    | Some range, None ->
      Error (Printf.sprintf "a range of %g m does not reach the ground from an altitude of %g m" range altitude)
    | None, Some angle when angle > 0. && angle < 180. ->
      Ok (Number (2. *. altitude *. tan (Dolphin_geo.Angle.radians (angle /. 2.))))
    | None, Some angle -> Error (Printf.sprintf "an angle of view is above 0 and below 180 degrees, not %g" angle)
    | None, None | Some _, Some _ ->
      Error "footprint takes either the range of a sidescan or the angle of view of a camera, as in range: 50.m"

(* Those without a name, and those with one. *)
let rec split keys arguments =
  match keys, arguments with
  | Some k :: keys, x :: arguments ->
    let positional, named = split keys arguments in
    (positional, (k, x) :: named)
  | None :: keys, x :: arguments ->
    let positional, named = split keys arguments in
    (x :: positional, named)
  | [], rest -> (rest, [])
  | _ :: _, [] -> ([], [])

let apply name keys arguments =
  let positional, named = split keys arguments in
  match name, positional with
  | "polygon", [ corners ] -> polygon corners (List.assoc_opt "holes" named)
  | "corridor", [ path; width ] -> corridor path width
  | "along", [ path; metres ] -> along path metres
  | "coverage", [ whole ] -> coverage whole named
  | "footprint", [] -> footprint named
  | ("expandingSquare" | "sector" | "spiral"), [ datum ] -> search name datum named
  | _, _ -> Error (Printf.sprintf "wrong number of arguments of %s, %d" name (List.length arguments))
