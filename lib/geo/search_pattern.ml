type error = Spacing of float | Radius of float | Bearing of float | Many_points of int

let ( let* ) = Result.bind
let most_radius = Plane.reach

let checked ?(spacing = 1.) ~radius ~bearing () =
  if not (Float.is_finite spacing && spacing > 0.) then Error (Spacing spacing)
  else if not (radius > 0. && radius <= most_radius) then Error (Radius radius)
  else if not (Float.is_finite bearing) then Error (Bearing bearing)
  else Ok ()

(* So that the number of points is one. *)
let bounded count make =
  if count > float_of_int Area.most_points then Error (Many_points (int_of_float (Float.min count 1e15)))
  else Ok (make (int_of_float count))

(* [ahead] along the bearing, [right] of it. *)
let placed datum bearing (ahead, right) =
  let angle = Angle.radians bearing in
  let north = (ahead *. cos angle) -. (right *. sin angle) and east = (ahead *. sin angle) +. (right *. cos angle) in
  if north = 0. && east = 0. then datum else Wgs84.displace datum ~north ~east

let expanding_square datum ~spacing ~radius ~bearing =
  let* () = checked ~spacing ~radius ~bearing () in
  let rings = Float.max 1. (Float.ceil ((radius /. spacing) -. 1e-9)) in
  let leg (x, y) i =
    let long = spacing *. float_of_int ((i / 2) + 1) in
    match i mod 4 with
    | 0 -> (x +. long, y)
    | 1 -> (x, y +. long)
    | 2 -> (x -. long, y)
    | _ -> (x, y -. long)
  in
  let make legs =
    let add (points, here) i = let next = leg here i in (next :: points, next) in
    let points, _ = List.fold_left add ([ (0., 0.) ], (0., 0.)) (List.init legs Fun.id) in
    List.rev_map (placed datum bearing) points
  in
  bounded ((4. *. rings) +. 1.) make

let sector datum ~radius ~bearing =
  let* () = checked ~radius ~bearing () in
  let at turn = Wgs84.move datum ~bearing:(bearing +. turn) radius in
  Ok [ datum; at 0.; at 60.; datum; at 240.; at 300.; datum; at 120.; at 180.; datum ]

let points_of_turn = 36

let spiral datum ~spacing ~radius ~bearing =
  let* () = checked ~spacing ~radius ~bearing () in
  let n = float_of_int points_of_turn in
  let point i =
    let share = float_of_int i /. n in
    let angle = 2. *. Float.pi *. share and metres = spacing *. share in
    placed datum bearing (metres *. cos angle, metres *. sin angle)
  in
  bounded (Float.ceil (n *. ((radius /. spacing) +. 0.5))) (fun last -> List.init (last + 1) point)

let pp_error ppf = function
  | Spacing x -> Fmt.pf ppf "the spacing of a search is above 0 m, not %g" x
  | Radius x -> Fmt.pf ppf "the radius of a search is above 0 and at most %g km, not %g m" (most_radius /. 1000.) x
  | Bearing x -> Fmt.pf ppf "a bearing is a finite number of degrees, not %g" x
  | Many_points n -> Fmt.pf ppf "this search would have %d points, more than %d" n Area.most_points
