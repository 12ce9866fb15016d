open Drawn

let position = Json_text.position Longitude_first

(* {1 Geometries} *)

let positions place json =
  let one i p = position (Printf.sprintf "%s, position %d" place (i + 1)) p in
  let rec all i found = function [] -> List.rev found | p :: ps -> all (i + 1) (one i p :: found) ps in
  match json with
  | `List (`List (_ :: _) :: _ as ps) -> (
      (* Places are worded only once something is wrong. *)
      try List.rev (List.rev_map (position place) ps) with Wrong _ -> all 0 [] ps)
  | json -> all 0 [] (Json_text.elements place json)

let way place json =
  match positions place json with
  | [] | [ _ ] -> wrong place "a line has two positions at least"
  | ps -> Way ps

let ring place json =
  match Json_text.elements place json with
  | [] -> wrong place "a polygon has a ring of positions"
  | rim :: holes ->
    { rim = positions place rim; holes = List.map (positions place) (List.filter (( <> ) (`List [])) holes) }

(* Writers give a geometry without a place empty lists. *)
let rec is_empty : Yojson.Safe.t -> bool = function `List parts -> List.for_all is_empty parts | _ -> false

let rec shapes place geometry =
  let coordinates = Json_text.member "coordinates" geometry in
  let unless_empty f = if coordinates = `Null || is_empty coordinates then [ empty ] else f () in
  let each f =
    unless_empty (fun () ->
        List.map f (List.filter (fun part -> not (is_empty part)) (Json_text.elements place coordinates))) in
  match Json_text.member "type" geometry with
  | `String "Point" -> unless_empty (fun () -> [ Spot (position place coordinates) ])
  | `String "MultiPoint" -> each (fun p -> Spot (position place p))
  | `String "LineString" -> unless_empty (fun () -> [ way place coordinates ])
  | `String "MultiLineString" -> each (way place)
  | `String "Polygon" -> unless_empty (fun () -> [ Ground [ ring place coordinates ] ])
  | `String "MultiPolygon" ->
    let polygons () = List.filter (fun part -> not (is_empty part)) (Json_text.elements place coordinates) in
    unless_empty (fun () -> [ Ground (List.map (ring place) (polygons ())) ])
  | `String "GeometryCollection" -> (
      match Json_text.member "geometries" geometry with
      | `Null -> [ empty ]
      | geometries -> non_empty (List.concat_map (shapes place) (Json_text.elements place geometries)))
  | `String other -> wrong place "GeoJSON has no geometry '%s'" other
  | _ -> wrong place "a geometry has a type, as \"Polygon\""

(* {1 Coordinate systems}

   Files from before RFC 7946 may name another than WGS 84. *)

let is_separator c = c = ':' || c = '/' || c = '#'

(* ["urn:ogc:def:crs:OGC:1.3:CRS84"], ["EPSG:4326"], ["http://www.opengis.net/def/crs/EPSG/0/4326"]. *)
let is_wgs_84 name =
  let name = String.uppercase_ascii (String.trim name) in
  let parts = String.split_on_char ':' (String.map (fun c -> if is_separator c then ':' else c) name) in
  let parts = List.filter (( <> ) "") parts in
  let is_of_epsg = List.mem "EPSG" parts || List.mem "EPSG.XML" parts in
  match List.rev parts with
  | ("CRS84" | "CRS84H") :: _ -> true
  | ("4326" | "4979") :: _ -> is_of_epsg
  | _ -> name = "WGS84" || name = "WGS 84"

let check_system place json =
  let refuse name =
    wrong place "its coordinates are in the system %s: they have to be in WGS 84, longitude first (EPSG:4326)" name in
  match Json_text.member "crs" json with
  | `Null -> ()
  | `String name -> if not (is_wgs_84 name) then refuse name
  | crs -> (
      let member name = Json_text.text (Json_text.member name (Json_text.member "properties" crs)) in
      let of_code code = "EPSG:" ^ code in
      match member "name", Option.map of_code (member "code"), member "href" with
      | Some name, _, _ | None, Some name, _ -> if not (is_wgs_84 name) then refuse name
      | None, None, Some address -> refuse (Printf.sprintf "at '%s', which is not looked up" address)
      | None, None, None -> refuse "of a crs that names none")

(* {1 Features} *)

let name feature =
  let properties = Json_text.member "properties" feature in
  let named = List.map (fun key -> Json_text.member key properties) [ "name"; "Name"; "NAME"; "title"; "label" ] in
  Option.value (List.find_map Json_text.text (named @ [ Json_text.member "id" feature ])) ~default:""

let feature i feature =
  let name = name feature in
  let place = Printf.sprintf "feature %d%s" (i + 1) (if name = "" then "" else Printf.sprintf " ('%s')" name) in
  check_system place feature;
  each ~name ~place (fun () ->
      if Json_text.member "type" feature <> `String "Feature" then wrong place "this is not a feature of GeoJSON";
      match Json_text.member "geometry" feature with
      | `Null -> [ no_geometry ]
      | geometry ->
        check_system place geometry;
        with_gaps (shapes place geometry))

let of_encoding text =
  match Utf8_text.repaired text with
  | _, 0 -> []
  | _, n ->
    let note = Printf.sprintf "%d byte%s not UTF-8, and read as U+FFFD" n (if n = 1 then " is" else "s are") in
    [ { name = ""; place = ""; shape = Note note } ]

let read text =
  let json = Json_text.read text in
  let place = "the geometry" in
  check_system "" json;
  let things =
    match Json_text.member "type" json with
    | `String "FeatureCollection" ->
      List.concat (List.mapi feature (Json_text.elements "the features" (Json_text.member "features" json)))
    | `String "Feature" -> feature 0 json
    | `String _ -> each ~name:"" ~place (fun () -> with_gaps (shapes place json))
    | _ -> wrong "" "this is not GeoJSON: it has no \"type\": \"FeatureCollection\""
  in
  of_encoding text @ things
