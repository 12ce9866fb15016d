open Drawn

let position = Json_text.position Longitude_first

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
  | rim :: holes -> { rim = positions place rim; holes = List.map (positions place) holes }

let rec shapes place geometry =
  let coordinates = Json_text.member "coordinates" geometry in
  let each f = List.map f (Json_text.elements place coordinates) in
  match Json_text.member "type" geometry with
  | `String "Point" -> [ Spot (position place coordinates) ]
  | `String "MultiPoint" -> each (fun p -> Spot (position place p))
  | `String "LineString" -> [ way place coordinates ]
  | `String "MultiLineString" -> each (way place)
  | `String "Polygon" -> [ Ground [ ring place coordinates ] ]
  | `String "MultiPolygon" -> [ Ground (each (ring place)) ]
  | `String "GeometryCollection" ->
    List.concat_map (shapes place) (Json_text.elements place (Json_text.member "geometries" geometry))
  | `String other -> wrong place "GeoJSON has no geometry '%s'" other
  | _ -> wrong place "a geometry has a type, as \"Polygon\""

let name feature =
  let properties = Json_text.member "properties" feature in
  let named = List.map (fun key -> Json_text.member key properties) [ "name"; "Name"; "NAME"; "title"; "label" ] in
  Option.value (List.find_map Json_text.text (named @ [ Json_text.member "id" feature ])) ~default:""

let feature i feature =
  let name = name feature in
  let place = Printf.sprintf "feature %d%s" (i + 1) (if name = "" then "" else Printf.sprintf " ('%s')" name) in
  if Json_text.member "type" feature <> `String "Feature" then wrong place "this is no feature of GeoJSON";
  match Json_text.member "geometry" feature with
  | `Null -> []
  | geometry -> List.map (fun shape -> { name; place; shape }) (shapes place geometry)

let read text =
  let json = Json_text.read text in
  match Json_text.member "type" json with
  | `String "FeatureCollection" ->
    List.concat (List.mapi feature (Json_text.elements "the features" (Json_text.member "features" json)))
  | `String "Feature" -> feature 0 json
  | `String _ -> List.map (fun shape -> { name = ""; place = "the geometry"; shape }) (shapes "the geometry" json)
  | _ -> wrong "" "this is no GeoJSON: it has no \"type\": \"FeatureCollection\""
