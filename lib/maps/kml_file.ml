open Drawn
open Xml_text

let is_blank c = c = ' ' || c = '\n' || c = '\t' || c = '\r'

let words text =
  let rec go i start found =
    let word () = if i > start then String.sub text start (i - start) :: found else found in
    if i = String.length text then List.rev (word ())
    else if is_blank text.[i] then go (i + 1) (i + 1) (word ())
    else go (i + 1) start found
  in
  go 0 0 []

let position x parts =
  match List.map (number x) (List.filter (fun part -> part <> "") parts) with
  | longitude :: latitude :: rest ->
    Drawn.position x.place ~latitude ~longitude ~height:(match rest with h :: _ -> h | [] -> 0.)
  | [ _ ] | [] -> wrong x.place "coordinates are LONGITUDE,LATITUDE or LONGITUDE,LATITUDE,HEIGHT"

let coordinates x =
  match child "coordinates" x with
  | None -> wrong x.place "%s has no coordinates" x.tag
  | Some c -> List.rev (List.rev_map (fun word -> position c (String.split_on_char ',' word)) (words c.text))

let way x = function [] | [ _ ] -> wrong x.place "a line has two positions at least" | ps -> Way ps

let polygon x =
  let ring side = List.concat_map (children "LinearRing") (children side x) in
  match ring "outerBoundaryIs" with
  | [] -> wrong x.place "a polygon has an outerBoundaryIs with a LinearRing"
  | rim :: _ -> { rim = coordinates rim; holes = List.map coordinates (ring "innerBoundaryIs") }

let track x = List.map (fun c -> position c (words c.text)) (children "coord" x)

let rec shapes x =
  match x.tag with
  | "Point" -> (
      match coordinates x with
      | p :: _ -> [ Spot p ]
      | [] -> wrong x.place "a point has a position")
  | "LineString" | "LinearRing" -> [ way x (coordinates x) ]
  | "Polygon" -> [ Ground [ polygon x ] ]
  | "Track" -> ( match track x with [] -> [] | [ p ] -> [ Spot p ] | ps -> [ Way ps ])
  | "MultiGeometry" | "MultiTrack" ->
    (* Polygons of one place are one area. *)
    let ground, others = List.partition (function Ground _ -> true | Spot _ | Way _ | Sketch _ | Round _ -> false)
        (List.concat_map shapes x.inside) in
    let rings = List.concat_map (function Ground rings -> rings | Spot _ | Way _ | Sketch _ | Round _ -> []) ground in
    if rings = [] then others else Ground rings :: others
  | _ -> []

let rec things x =
  if x.tag = "Placemark" then
    let name = text_of "name" x in
    List.map (fun shape -> { name; place = x.place; shape }) (List.concat_map shapes x.inside)
  else List.concat_map things x.inside

let read text =
  let root = Xml_text.read text in
  if root.tag <> "kml" then wrong root.place "this is no KML: its root is '%s'" root.tag;
  things root
