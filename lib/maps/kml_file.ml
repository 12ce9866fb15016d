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
  | [ longitude; latitude ] -> Drawn.position x.place ~latitude ~longitude ~height:0.
  | [ longitude; latitude; height ] -> Drawn.position x.place ~latitude ~longitude ~height
  | [] | _ :: _ -> wrong x.place "coordinates are LONGITUDE,LATITUDE or LONGITUDE,LATITUDE,HEIGHT"

let coordinates x =
  match children "coordinates" x with
  | [] -> []
  | _ :: second :: _ -> wrong second.place "%s has coordinates twice" x.tag
  | [ c ] -> List.rev (List.rev_map (fun word -> position c (String.split_on_char ',' word)) (words c.text))

let way x = function
  | [] -> [ empty ]
  | [ _ ] -> wrong x.place "a line has two positions at least"
  | ps -> [ Way ps ]

let ring x =
  match coordinates x with
  | first :: _ :: _ as ps when gap ps > accuracy -> Way (ps @ [ first ]) :: closing "the ring" ps
  | ps -> way x ps

let polygon x =
  let rings side = List.concat_map (children "LinearRing") (children side x) in
  let non_empty rings = List.filter (( <> ) []) (List.map coordinates rings) in
  match non_empty (rings "outerBoundaryIs"), non_empty (rings "innerBoundaryIs") with
  | [ rim ], holes -> [ Ground [ { rim; holes } ] ]
  | _ :: _ :: _, _ -> wrong x.place "a polygon has one outer ring: several are a MultiGeometry of polygons"
  | [], [] -> [ empty ]
  | [], _ :: _ -> wrong x.place "a polygon has an outerBoundaryIs with a LinearRing"

let track x = List.map (fun c -> position c (words c.text)) (children "coord" x)

let rec has_coordinates x =
  List.exists (fun y -> y.tag = "coordinates" || y.tag = "coord" || has_coordinates y) x.inside

let rec shapes x =
  match x.tag with
  | "Point" -> (
      match coordinates x with
      | [ p ] -> [ Spot p ]
      | [] -> [ empty ]
      | _ :: _ :: _ as ps -> wrong x.place "a point has one position, not %d" (List.length ps))
  | "LineString" -> way x (coordinates x)
  | "LinearRing" -> ring x
  | "Polygon" -> polygon x
  | "Track" -> ( match track x with [] -> [ empty ] | [ p ] -> [ Spot p ] | ps -> [ Way ps ])
  | "MultiGeometry" | "MultiTrack" | "MultiPolygon" | "MultiLineString" | "MultiPoint" ->
    (* Polygons of one place are one area. *)
    let ground, others =
      List.partition_map (function Ground rings -> Either.Left rings | other -> Either.Right other)
        (non_empty (List.concat_map shapes x.inside)) in
    let rings = List.concat ground in
    if rings = [] then others else Ground rings :: others
  | "Model" -> [ Note "a model has no shape on the ground, and is left out" ]
  | tag -> if has_coordinates x then [ Note (tag ^ " is not known here, and left out") ] else []

let link x =
  let of_child tag = Option.fold (child tag x) ~none:"" ~some:(text_of "href") in
  match of_child "Link" with "" -> of_child "Url" | href -> href

let rec things ~follow x =
  let name = text_of "name" x in
  match x.tag with
  | "Placemark" ->
    let found () = match List.concat_map shapes x.inside with [] -> [ no_geometry ] | shapes -> with_gaps shapes in
    each ~name ~place:x.place found
  | "NetworkLink" ->
    let href = link x in
    if follow href then [] else left_out ~name x.place "the link to '%s' is not followed" href
  | "GroundOverlay" | "PhotoOverlay" -> left_out ~name x.place "%s is a picture" x.tag
  | _ -> List.concat_map (things ~follow) x.inside

let read ~follow text =
  let root = Xml_text.read text in
  if root.tag <> "kml" then wrong root.place "this is not KML: its root is '%s'" root.tag;
  things ~follow root
