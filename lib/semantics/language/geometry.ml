open Dolphin_results
open Core

let ( let* ) = Result.bind

let number what x =
  match Value.to_number x with
  | Some n when Float.is_finite n -> Ok n
  | Some _ -> Error (Printf.sprintf "expected %s, found no finite number" what)
  | None -> Operators.expected what x

let position what = function Position p -> Ok p | x -> Operators.expected what x

let positions what = function
  | List xs -> Results.map (position ("a position in " ^ what)) (Array.to_list xs)
  | x -> Operators.expected (Printf.sprintf "%s, a list of positions" what) x

let along path metres =
  let* path = positions "a path" path in
  let* metres = number "metres along a path" metres in
  match Dolphin_geo.Wgs84.along path metres with
  | Some p -> Ok (Position p)
  | None -> Error "a path without positions leads nowhere"

let apply name _keys arguments =
  match name, arguments with
  | "along", [ path; metres ] -> along path metres
  | _, _ -> Error (Printf.sprintf "wrong number of arguments of %s, %d" name (List.length arguments))
