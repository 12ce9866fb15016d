(* Names follow T. Vincenty, "Direct and inverse solutions of geodesics on the ellipsoid with application of nested
   equations", Survey Review 176, 1975. A reduced latitude is that of the auxiliary sphere. *)

open Angle

let semi_major_axis = 6_378_137.

let flattening = 1. /. 298.257223563

let semi_minor_axis = semi_major_axis *. (1. -. flattening)

let mean_radius = ((2. *. semi_major_axis) +. semi_minor_axis) /. 3.

let pi = Float.pi

let square x = x *. x

let sine_and_cosine x = (sin x, cos x)

let reduced_latitude latitude =
  (* At a pole the tangent is huge but finite, and the arc tangent brings it back. *)
  atan ((1. -. flattening) *. tan (radians latitude))

(* The coefficients A and B of the series for the length of an arc of the geodesic with this cos²(alpha). *)
let series cosine_squared_alpha =
  let u_squared =
    cosine_squared_alpha
    *. (square semi_major_axis -. square semi_minor_axis)
    /. square semi_minor_axis
  in
  let a =
    1. +. (u_squared /. 16384. *. (4096. +. (u_squared *. (-768. +. (u_squared *. (320. -. (175. *. u_squared)))))))
  in
  let b = u_squared /. 1024. *. (256. +. (u_squared *. (-128. +. (u_squared *. (74. -. (47. *. u_squared)))))) in
  (a, b)

let delta_sigma b ~sine_sigma ~cosine_sigma ~cosine_two_sigma_m =
  let twice = -1. +. (2. *. square cosine_two_sigma_m) in
  b *. sine_sigma
  *. (cosine_two_sigma_m
      +. b /. 4.
         *. ((cosine_sigma *. twice)
             -. b /. 6. *. cosine_two_sigma_m
                *. (-3. +. (4. *. square sine_sigma))
                *. (-3. +. (4. *. square cosine_two_sigma_m))))

(* The excess of longitudes on the auxiliary sphere over those on the ellipsoid. *)
let longitude_excess ~sine_alpha ~cosine_squared_alpha ~sigma ~sine_sigma ~cosine_sigma ~cosine_two_sigma_m =
  let c =
    flattening /. 16. *. cosine_squared_alpha *. (4. +. (flattening *. (4. -. (3. *. cosine_squared_alpha))))
  in
  (1. -. c) *. flattening *. sine_alpha
  *. (sigma
      +. c *. sine_sigma
         *. (cosine_two_sigma_m +. (c *. cosine_sigma *. (-1. +. (2. *. square cosine_two_sigma_m)))))

(* [from_minus_half_turn x] is the angle [x], in degrees, brought above -180 and to at most 180. *)
let from_minus_half_turn x =
  let x = Float.rem x 360. in
  if x > 180. then x -. 360. else if x <= -180. then x +. 360. else x

let from_zero x =
  let x = Float.rem x 360. in
  let x = if x < 0. then x +. 360. else x in
  if x >= 360. then 0. else x

let on_sphere (a : Position.t) (b : Position.t) =
  let sine_a, cosine_a = sine_and_cosine (radians a.latitude) in
  let sine_b, cosine_b = sine_and_cosine (radians b.latitude) in
  let sine_longitude, cosine_longitude = sine_and_cosine (radians (b.longitude -. a.longitude)) in
  let y = cosine_b *. sine_longitude in
  let x = (cosine_a *. sine_b) -. (sine_a *. cosine_b *. cosine_longitude) in
  let z = (sine_a *. sine_b) +. (cosine_a *. cosine_b *. cosine_longitude) in
  (mean_radius *. atan2 (hypot x y) z, atan2 y x)

let rounds = 200

(* [inverse a b] is the distance in metres, and the initial course in radians. *)
let inverse (a : Position.t) (b : Position.t) =
  let sine_a, cosine_a = sine_and_cosine (reduced_latitude a.latitude) in
  let sine_b, cosine_b = sine_and_cosine (reduced_latitude b.latitude) in
  let longitude = radians (from_minus_half_turn (b.longitude -. a.longitude)) in
  let rec improve lambda round =
    let sine_lambda, cosine_lambda = sine_and_cosine lambda in
    let y = cosine_b *. sine_lambda in
    let x = (cosine_a *. sine_b) -. (sine_a *. cosine_b *. cosine_lambda) in
    let sine_sigma = hypot x y in
    let cosine_sigma = (sine_a *. sine_b) +. (cosine_a *. cosine_b *. cosine_lambda) in
    if sine_sigma = 0. then if cosine_sigma > 0. then (0., 0.) else on_sphere a b
    else
      let sigma = atan2 sine_sigma cosine_sigma in
      let sine_alpha = cosine_a *. cosine_b *. sine_lambda /. sine_sigma in
      let cosine_squared_alpha = 1. -. square sine_alpha in
      let cosine_two_sigma_m =
        if cosine_squared_alpha < 1e-15 then 0. (* along the equator *)
        else cosine_sigma -. (2. *. sine_a *. sine_b /. cosine_squared_alpha)
      in
      let excess =
        longitude_excess ~sine_alpha ~cosine_squared_alpha ~sigma ~sine_sigma ~cosine_sigma ~cosine_two_sigma_m
      in
      let lambda' = longitude +. excess in
      if Float.abs lambda' > pi then on_sphere a b
      else if Float.abs (lambda' -. lambda) < 1e-13 then
        let series_a, series_b = series cosine_squared_alpha in
        let delta = delta_sigma series_b ~sine_sigma ~cosine_sigma ~cosine_two_sigma_m in
        (semi_minor_axis *. series_a *. (sigma -. delta), atan2 y x)
      else if round = 0 then on_sphere a b
      else improve lambda' (round - 1)
  in
  improve longitude rounds

(* [direct a course metres] is the end of the geodesic of [metres] that leaves [a] on [course], in radians. *)
let direct (a : Position.t) course metres =
  let sine_course, cosine_course = sine_and_cosine course in
  let reduced = reduced_latitude a.latitude in
  let sine_a, cosine_a = sine_and_cosine reduced in
  let sigma_a = atan2 (tan reduced) cosine_course in
  let sine_alpha = cosine_a *. sine_course in
  let cosine_squared_alpha = 1. -. square sine_alpha in
  let series_a, series_b = series cosine_squared_alpha in
  let whole = metres /. (semi_minor_axis *. series_a) in
  let rec improve sigma round =
    let cosine_two_sigma_m = cos ((2. *. sigma_a) +. sigma) in
    let sine_sigma, cosine_sigma = sine_and_cosine sigma in
    let sigma' = whole +. delta_sigma series_b ~sine_sigma ~cosine_sigma ~cosine_two_sigma_m in
    if Float.abs (sigma' -. sigma) < 1e-14 || round = 0 then sigma' else improve sigma' (round - 1)
  in
  let sigma = improve whole rounds in
  let cosine_two_sigma_m = cos ((2. *. sigma_a) +. sigma) in
  let sine_sigma, cosine_sigma = sine_and_cosine sigma in
  let across = (sine_a *. sine_sigma) -. (cosine_a *. cosine_sigma *. cosine_course) in
  let latitude =
    atan2
      ((sine_a *. cosine_sigma) +. (cosine_a *. sine_sigma *. cosine_course))
      ((1. -. flattening) *. hypot sine_alpha across)
  in
  let lambda =
    atan2 (sine_sigma *. sine_course) ((cosine_a *. cosine_sigma) -. (sine_a *. sine_sigma *. cosine_course))
  in
  let excess =
    longitude_excess ~sine_alpha ~cosine_squared_alpha ~sigma ~sine_sigma ~cosine_sigma ~cosine_two_sigma_m
  in
  let longitude = from_minus_half_turn (a.longitude +. degrees (lambda -. excess)) in
  { a with latitude = degrees latitude; longitude }

let finite operation x = if not (Float.is_finite x) then Fmt.invalid_arg "Wgs84.%s: %g" operation x

let distance a b = fst (inverse a b)

let bearing a b = from_zero (degrees (snd (inverse a b)))

let displacement a b =
  let metres, course = inverse a b in
  (metres *. cos course, metres *. sin course)

let move a ~bearing metres =
  finite "move" bearing;
  finite "move" metres;
  if metres = 0. then a else direct a (radians bearing) metres

let farthest = 20_000_000.

let displace a ~north ~east =
  finite "displace" north;
  finite "displace" east;
  if north = 0. && east = 0. then a else direct a (atan2 east north) (hypot north east)

let towards (a : Position.t) (b : Position.t) metres =
  finite "towards" metres;
  if metres <= 0. then a
  else
    let length, course = inverse a b in
    if metres >= length then b
    else
      let height = a.height +. ((b.height -. a.height) *. metres /. length) in
      { (direct a course metres) with height }

let interpolate a b share =
  finite "interpolate" share;
  if share <= 0. then a else if share >= 1. then b else towards a b (share *. distance a b)

let along path metres =
  finite "along" metres;
  let rec go metres (a : Position.t) = function
    | [] -> a
    | b :: rest ->
      let length = distance a b in
      if metres <= length then towards a b metres else go (metres -. length) b rest
  in
  match path with [] -> None | first :: rest -> Some (go metres first rest)

type cartesian = { x : float; y : float; z : float }

let cartesian (p : Position.t) =
  let eccentricity_squared = flattening *. (2. -. flattening) in
  let latitude = radians p.latitude and longitude = radians p.longitude in
  let sine = sin latitude in
  let normal = semi_major_axis /. sqrt (1. -. (eccentricity_squared *. square sine)) in
  let from_axis = (normal +. p.height) *. cos latitude in
  {
    x = from_axis *. cos longitude;
    y = from_axis *. sin longitude;
    z = ((normal *. (1. -. eccentricity_squared)) +. p.height) *. sine;
  }

let straight a b =
  sqrt (square (a.x -. b.x) +. square (a.y -. b.y) +. square (a.z -. b.z))

(* {1 Through the earth} *)

type vector = { x : float; y : float; z : float }

let vector (p : Position.t) =
  let sine, cosine = sine_and_cosine (radians p.latitude) and east, ahead = sine_and_cosine (radians p.longitude) in
  let square_eccentricity = flattening *. (2. -. flattening) in
  let normal = semi_major_axis /. sqrt (1. -. (square_eccentricity *. square sine)) in
  { x = normal *. cosine *. ahead; y = normal *. cosine *. east; z = normal *. (1. -. square_eccentricity) *. sine }

let chord a b = sqrt (square (a.x -. b.x) +. square (a.y -. b.y) +. square (a.z -. b.z))
