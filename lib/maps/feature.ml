open Dolphin_geo

type sample = { time : float; position : Position.t }
type geometry = Point of Position.t | Line of Position.t list | Track of sample list list
type property = Text of string | Number of float
type t = { name : string; geometry : geometry; properties : (string * property) list }

let begin_of_year year =
  let before = year - 1 in
  let leap_days = (before / 4) - (before / 100) + (before / 400) in
  86400. *. float_of_int ((365 * before) + leap_days - 719_162)

let utc seconds =
  let seconds = Float.min seconds (begin_of_year 10_000 -. 1.) in
  let milliseconds = Float.round (seconds *. 1000.) in
  let whole = Float.floor (milliseconds /. 1000.) in
  let rest = int_of_float (milliseconds -. (whole *. 1000.)) in
  let t = Unix.gmtime whole in
  Printf.sprintf "%04d-%02d-%02dT%02d:%02d:%02d%sZ" (t.tm_year + 1900) (t.tm_mon + 1) t.tm_mday t.tm_hour t.tm_min
    t.tm_sec
    (if rest = 0 then "" else Printf.sprintf ".%03d" rest)

let parts line =
  (* Both sides of the meridian, at its crossing with the straight line between two longitudes. *)
  let crossing (a : Position.t) (b : Position.t) =
    let side = if a.longitude < 0. then -180. else 180. in
    let beyond = b.longitude +. (2. *. side) in
    let share = if beyond = a.longitude then 0. else (side -. a.longitude) /. (beyond -. a.longitude) in
    let between x y = x +. (share *. (y -. x)) in
    let at longitude : Position.t =
      { latitude = between a.latitude b.latitude; longitude; height = between a.height b.height } in
    (at side, at (-.side))
  in
  let add parts (p : Position.t) =
    match parts with
    | ((last :: _) as part) :: others when Float.abs (last.Position.longitude -. p.longitude) > 180. ->
      let here, there = crossing last p in
      [ p; there ] :: (if here = last then part else here :: part) :: others
    | part :: others -> (p :: part) :: others
    | [] -> [ [ p ] ]
  in
  List.rev_map List.rev (List.fold_left add [] line)
