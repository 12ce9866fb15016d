open Dolphin_geo
open Drawn
open Xml_text
module Numeral = Dolphin_numerals.Numeral

(* [41.185], [1.0E-5], [38.82593N], [41N11'9.8''], [8W42.5']: a number, or one with a letter of [letters]. *)
let degrees x letters text =
  let letter c = Option.map (fun i -> (c, i)) (String.index_opt text c) in
  match Numeral.number text, List.find_map letter letters with
  | Some degrees, (Some _ | None) -> degrees
  | None, None -> number x text
  | None, Some (letter, i) ->
    let parts = String.split_on_char '\'' (String.sub text (i + 1) (String.length text - i - 1)) in
    let sixtieths part =
      let size = number x part in
      if Float.sign_bit size || size > 60. then wrong x.place "'%s' is not a number of minutes or seconds" part;
      size
    in
    let part n = match List.nth_opt parts n with Some "" | None -> 0. | Some part -> sixtieths part in
    let size = number x (String.sub text 0 i) +. (part 0 /. 60.) +. (part 1 /. 3600.) in
    if letter = 'S' || letter = 'W' then -.size else size

let metres tag x = match text_of tag x with "" -> 0. | text -> number x text

let location x =
  match child "coordinate" x with
  | None -> wrong x.place "%s has no coordinate" x.tag
  | Some c ->
    let height = metres "height" c -. metres "depth" c +. metres "offset-up" c -. metres "offset-down" c in
    let latitude = degrees c [ 'N'; 'S' ] (text_of "latitude" c) in
    let longitude = degrees c [ 'E'; 'W' ] (text_of "longitude" c) in
    let p = Drawn.position c.place ~latitude ~longitude ~height in
    let north = metres "offset-north" c -. metres "offset-south" c in
    let east = metres "offset-east" c -. metres "offset-west" c in
    if north = 0. && east = 0. then p else Wgs84.displace p ~north ~east

let heading x = match child "attitude" x with Some a -> metres "psi" a | None -> 0.

let path x =
  let from = location x in
  let moved t = Wgs84.displace from ~north:(metres "n" t) ~east:(metres "e" t) in
  match List.rev (List.rev_map moved (children "translation" x)) with
  | [] | [ _ ] -> []
  | ps when text_of "shape" x = "true" && List.length ps > 2 -> [ Sketch ps ]
  | ps -> [ Way ps ]

(* [ahead] and [right] of the element's heading. *)
let beside x centre ahead right =
  let p = Wgs84.move centre ~bearing:(heading x) ahead in
  Wgs84.move p ~bearing:(heading x +. 90.) right

let geometry x =
  match child "dimensions" x with
  | None -> []
  | Some d ->
    let centre = location x in
    let right = metres "x-dim" d /. 2. and ahead = metres "y-dim" d /. 2. in
    if text_of "type" x = "Parallelepiped" then
      let corner (a, r) = beside x centre (a *. ahead) (r *. right) in
      [ Ground [ { rim = List.map corner [ (-1., -1.); (-1., 1.); (1., 1.); (1., -1.) ]; holes = [] } ] ]
    else [ Round { centre; radius = right } ]

(* [37.57,-1.002;37.58,-1.003]. *)
let route x =
  let position text =
    match List.map (number x) (String.split_on_char ',' text) with
    | latitude :: longitude :: _ -> Drawn.position x.place ~latitude ~longitude ~height:0.
    | [ _ ] | [] -> wrong x.place "a path is LATITUDE,LONGITUDE;LATITUDE,LONGITUDE"
  in
  match List.filter (fun text -> text <> "") (String.split_on_char ';' (text_of "path" x)) with
  | [] | [ _ ] -> []
  | texts -> [ Way (List.map position texts) ]

let segment x =
  let centre = location x and half = metres "length" x /. 2. in
  [ Way [ beside x centre (-.half) 0.; beside x centre half 0. ] ]

let things x =
  let shapes () =
    match x.tag with
    | "mark" | "transponder" -> [ Spot (location x) ]
    | "path" -> path x
    | "geometry" -> geometry x
    | "MineDangerAreaElement" -> [ Round { centre = location x; radius = metres "radius" x } ]
    | "QRouteElement" -> route x
    | "LineSegmentElement" -> segment x
    | _ -> []
  in
  let name = match text_of "id" x with "" -> text_of "name" x | id -> id in
  each ~name ~place:x.place shapes

let read text =
  let root = Xml_text.read text in
  if root.tag <> "map" then wrong root.place "this is not a map of Neptus: its root is '%s'" root.tag;
  List.concat_map things (List.concat_map (fun features -> features.inside) (children "features" root))
