open Dolphin_geo

(* A rectangle's rim, and the rims of rectangles that tile it: in fractions of its width and height. *)
type tile = { west : float; south : float; east : float; north : float }
type cut = Upright of float | Level of float
type drawn = { latitude : float; metres : float; digits : int; cuts : (int * cut) list; turned : bool }

let rec cut_once tiles (i, cut) =
  match tiles with
  | [] -> []
  | t :: others when i = 0 -> (
      match cut with
      | Upright share ->
        let x = t.west +. (share *. (t.east -. t.west)) in
        { t with east = x } :: { t with west = x } :: others
      | Level share ->
        let y = t.south +. (share *. (t.north -. t.south)) in
        { t with north = y } :: { t with south = y } :: others)
  | t :: others -> t :: cut_once others (i - 1, cut)

let whole = { west = 0.; south = 0.; east = 1.; north = 1. }

(* Tiles that a cut left are in the list; a cut names one by its number, modulo their count. *)
let tiles cuts =
  List.fold_left (fun tiles (i, cut) -> cut_once tiles (i mod List.length tiles, cut)) [ whole ] cuts

(* As files have it: with some digits behind the point. The rectangle is turned by about 20 degrees. *)
let corner d (x, y) : Position.t =
  let x, y = if d.turned then ((0.94 *. x) -. (0.34 *. y), (0.34 *. x) +. (0.94 *. y)) else (x, y) in
  let rounded z =
    let one = 10. ** float_of_int d.digits in
    Float.round (z *. one) /. one in
  let p = Wgs84.displace { latitude = d.latitude; longitude = -8.7; height = 0. } ~north:(y *. d.metres)
      ~east:(x *. d.metres) in
  { p with latitude = rounded p.latitude; longitude = rounded p.longitude }

let rim d t = List.map (corner d) [ (t.west, t.south); (t.east, t.south); (t.east, t.north); (t.west, t.north) ]
let polygon d tiles = Repair.polygon ~holes:(List.map (rim d) tiles) (rim d whole)

let drawn =
  let open QCheck2.Gen in
  let share = float_range 0.25 0.75 in
  let cut = oneof [ map (fun x -> Upright x) share; map (fun y -> Level y) share ] in
  let* latitude = float_range (-60.) 60. and* metres = float_range 200. 20_000. and* digits = int_range 6 12 in
  let* cuts = list_size (int_range 0 5) (pair (int_bound 5) cut) and* turned = bool in
  return { latitude; metres; digits; cuts; turned }

let print d =
  let tile t = Printf.sprintf "%g,%g to %g,%g" t.west t.south t.east t.north in
  Printf.sprintf "at %h, %h m, %d digits, turned: %b: %s" d.latitude d.metres d.digits d.turned
    (String.concat "; " (List.map tile (tiles d.cuts)))

(* Whether the tiles cover their rectangle but for what rounding leaves open: nothing, then, is an area. *)
let nothing_is_left d =
  match polygon d (tiles d.cuts) with
  | Error (Empty | Hole_outside _) -> true
  | Error e -> QCheck2.Test.fail_report (Format.asprintf "%a" Area.pp_error e)
  | Ok (area, _) -> QCheck2.Test.fail_report (Printf.sprintf "%g m2 are left" (Area.size area))

(* Without one of its tiles, it is an area of about that tile's size. *)
let one_is_left d =
  match tiles d.cuts with
  | [ _ ] | [] -> true
  | left :: holes -> (
      match polygon d holes with
      | Error (Hole_outside _) -> true
      | Error e -> QCheck2.Test.fail_report (Format.asprintf "%a" Area.pp_error e)
      | Ok (area, _) ->
        let expected = (left.east -. left.west) *. (left.north -. left.south) *. d.metres *. d.metres in
        Float.abs ((Area.size area /. expected) -. 1.) < 0.1)

let wall () =
  let at (east, north) = Wgs84.displace { latitude = 41.18; longitude = -8.7; height = 0. } ~north ~east in
  let square x side = List.map at [ (x, x); (x +. side, x); (x +. side, x +. side); (x, x +. side) ] in
  match Repair.polygon ~holes:[ square 1. 9998. ] (square 0. 10000.) with
  | Ok (area, []) -> Alcotest.(check (float 10.)) "a wall of a metre" 39_996. (Area.size area)
  | Ok (_, _ :: _) | Error _ -> Alcotest.fail "a wall of a metre around a hole of 10 km is an area"

let () =
  Alcotest.run "holes"
    [ ( "holes",
        [ Test_support.Property.case ~count:200 "holes that tile a polygon leave nothing" ~print drawn nothing_is_left;
          Test_support.Property.case ~count:200 "all tiles but one leave that one" ~print drawn one_is_left;
          Alcotest.test_case "a thin wall" `Quick wall ] ) ]
