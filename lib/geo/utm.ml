(* L. Krüger, "Konforme Abbildung des Erdellipsoids in der Ebene", 1912, to the order of C. Karney, "Transverse
   Mercator with an accuracy of a few nanometers", J. Geodesy 85, 2011: equations 12, 25 and 36. *)

open Angle

type half = North | South

let semi_major_axis = 6_378_137.
let flattening = 1. /. 298.257223563
let third_flattening = flattening /. (2. -. flattening)
let scale = 0.9996

(* The coefficients [c0 + c1 n + c2 n² + ...]. *)
let series coefficients =
  List.fold_right (fun c rest -> c +. (third_flattening *. rest)) coefficients 0.

let rectifying_radius =
  semi_major_axis /. (1. +. third_flattening) *. series [ 1.; 0.; 1. /. 4.; 0.; 1. /. 64.; 0.; 1. /. 256. ]

let beta =
  List.map series
    [ [ 0.; 1. /. 2.; -2. /. 3.; 37. /. 96.; -1. /. 360.; -81. /. 512.; 96199. /. 604800. ];
      [ 0.; 0.; 1. /. 48.; 1. /. 15.; -437. /. 1440.; 46. /. 105.; -1118711. /. 3870720. ];
      [ 0.; 0.; 0.; 17. /. 480.; -37. /. 840.; -209. /. 4480.; 5569. /. 90720. ];
      [ 0.; 0.; 0.; 0.; 4397. /. 161280.; -11. /. 504.; -830251. /. 7257600. ];
      [ 0.; 0.; 0.; 0.; 0.; 4583. /. 161280.; -108847. /. 3991680. ];
      [ 0.; 0.; 0.; 0.; 0.; 0.; 20648693. /. 638668800. ] ]

(* [tangent conformal] is the tangent of the latitude whose conformal latitude has the tangent [conformal]. *)
let tangent conformal =
  let eccentricity = sqrt (flattening *. (2. -. flattening)) in
  let atanh x = 0.5 *. Float.log1p (2. *. x /. (1. -. x)) in
  let of_tangent t =
    let s = sinh (eccentricity *. atanh (eccentricity *. t /. sqrt (1. +. (t *. t)))) in
    (t *. sqrt (1. +. (s *. s))) -. (s *. sqrt (1. +. (t *. t)))
  in
  let complement = 1. -. (eccentricity *. eccentricity) in
  let rec improve t round =
    let c = of_tangent t in
    let slope = complement *. sqrt (1. +. (t *. t)) *. sqrt (1. +. (c *. c)) /. (1. +. (complement *. t *. t)) in
    let t' = t +. ((conformal -. c) /. slope) in
    if round = 0 || Float.abs (t' -. t) < 1e-15 *. Float.max 1. (Float.abs t) then t' else improve t' (round - 1)
  in
  improve (conformal /. complement) 8

let on_ellipsoid ~central_meridian ~easting ~northing =
  let xi = northing /. (scale *. rectifying_radius) in
  let eta = (easting -. 500_000.) /. (scale *. rectifying_radius) in
  let correct (x, y) j b =
    let k = 2. *. float_of_int (j + 1) in
    (x -. (b *. sin (k *. xi) *. cosh (k *. eta)), y -. (b *. cos (k *. xi) *. sinh (k *. eta)))
  in
  let xi', eta' =
    List.fold_left (fun (x, y) (j, b) -> correct (x, y) j b) (xi, eta) (List.mapi (fun j b -> (j, b)) beta)
  in
  let t = tangent (sin xi' /. hypot (sinh eta') (cos xi')) in
  (degrees (atan t), central_meridian +. degrees (atan2 (sinh eta') (cos xi')))

let around x = if x > 180. then x -. 360. else if x < -180. then x +. 360. else x

let position ~zone half ~easting ~northing =
  if zone < 1 || zone > 60 then Error (Printf.sprintf "UTM has the zones 1 to 60, not %d" zone)
  else if not (easting >= 100_000. && easting <= 900_000.) then
    Error (Printf.sprintf "eastings of UTM are from 100000 to 900000 m, not %.15g" easting)
  else if not (northing >= 0. && northing <= 10_000_000.) then
    Error (Printf.sprintf "northings of UTM are from 0 to 10000000 m, not %.15g" northing)
  else
    let northing = match half with North -> northing | South -> northing -. 10_000_000. in
    let central_meridian = float_of_int ((6 * zone) - 183) in
    let latitude, longitude = on_ellipsoid ~central_meridian ~easting ~northing in
    Ok { Position.latitude; longitude = around longitude; height = 0. }

let bands = "CDEFGHJKLMNPQRSTUVWX"

let band latitude =
  if latitude < -80. || latitude > 84. then None
  else Some bands.[min (String.length bands - 1) (int_of_float (Float.floor ((latitude +. 80.) /. 8.)))]
