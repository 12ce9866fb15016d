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

let polygon corners holes =
  let* corners = positions "the corners of a polygon" corners in
  let* holes =
    match holes with
    | None -> Ok []
    | Some (List holes) -> Results.map (positions "a hole") (Array.to_list holes)
    | Some x -> Operators.expected "holes, a list of lists of positions" x
  in
  Operators.area (Dolphin_geo.Area.polygon ~holes corners)

let corridor path width =
  let* path = positions "a path" path in
  let* width = number "a width in metres" width in
  Operators.area (Dolphin_geo.Area.corridor path width)

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
  | _, _ -> Error (Printf.sprintf "wrong number of arguments of %s, %d" name (List.length arguments))
