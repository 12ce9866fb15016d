open Dolphin_geo
open Feature

(* Tracks are long: in constant stack. *)
module List = struct
  include List

  let map f xs = rev (rev_map f xs)
end

let ( @ ) xs ys = List.rev_append (List.rev xs) ys

let rounded digits x =
  let one = 10. ** float_of_int digits in
  let x = Float.round (x *. one) /. one in
  if x = 0. then 0. else x

let number x = if Float.is_integer x && Float.abs x < 1e15 then Printf.sprintf "%.0f" x else Printf.sprintf "%.12g" x
let degrees x = number (rounded 8 x)
let metres x = number (rounded 3 x)

(* {1 GeoJSON} *)

(* In as few digits as it takes. *)
let json_number x : Yojson.Safe.t = `Intlit (number x)

let json_position (p : Position.t) : Yojson.Safe.t =
  `List [ json_number (rounded 8 p.longitude); json_number (rounded 8 p.latitude); json_number (rounded 3 p.height) ]

let json_property : property -> Yojson.Safe.t = function Text text -> `String text | Number x -> json_number x

(* A line has two positions at least. *)
let twice = function [ x ] -> [ x; x ] | xs -> xs

let lines parts : Yojson.Safe.t =
  match List.map (fun part -> `List (List.map json_position (twice part))) parts with
  | [ line ] -> `Assoc [ ("type", `String "LineString"); ("coordinates", line) ]
  | lines -> `Assoc [ ("type", `String "MultiLineString"); ("coordinates", `List lines) ]

(* A track has one time for each position: a point where it is cut in two has none. *)
let json_geometry : geometry -> Yojson.Safe.t * (string * Yojson.Safe.t) list = function
  | Point p -> (`Assoc [ ("type", `String "Point"); ("coordinates", json_position p) ], [])
  | Line line -> (lines (Feature.parts line), [])
  | Track parts ->
    let positions part = List.map (fun s -> s.position) part in
    let whole = List.for_all (fun part -> List.length (Feature.parts (positions part)) = 1) parts in
    if not whole then (lines (List.concat_map (fun part -> Feature.parts (positions part)) parts), [])
    else
      let times part = `List (List.map (fun s -> `String (utc s.time)) (twice part)) in
      let all = match List.map times parts with [ one ] -> one | several -> `List several in
      (lines (List.map positions parts), [ ("coordTimes", all) ])

let json_feature f : Yojson.Safe.t =
  let geometry, times = json_geometry f.geometry in
  let properties = List.map (fun (k, x) -> (k, json_property x)) f.properties in
  `Assoc
    [ ("type", `String "Feature"); ("properties", `Assoc ((("name", `String f.name) :: properties) @ times));
      ("geometry", geometry) ]

let geojson features =
  let lines = List.map (fun f -> Dolphin_json_text.Canonical.to_string (json_feature f)) features in
  "{\"type\":\"FeatureCollection\",\"features\":[\n" ^ String.concat ",\n" lines ^ "\n]}\n"

(* {1 XML} *)

type xml = Element of string * (string * string) list * xml list | Data of string

(* XML does not have most control characters, nor U+FFFE and U+FFFF. *)
let readable text =
  let spaced = String.map (fun c -> if c < ' ' && c <> '\n' then ' ' else c) text in
  String.concat "\n" (List.map Dolphin_utf8.Utf8.line (String.split_on_char '\n' spaced))

let document root =
  let buffer = Buffer.create 65536 in
  let output = Xmlm.make_output ~nl:true (`Buffer buffer) in
  let rec put = function
    | Data text -> Xmlm.output output (`Data (readable text))
    | Element (name, attributes, inside) ->
      let attributes = List.map (fun (name, value) -> (("", name), readable value)) attributes in
      Xmlm.output output (`El_start (("", name), attributes));
      List.iter put inside;
      Xmlm.output output `El_end
  in
  Xmlm.output output (`Dtd None);
  put root;
  Buffer.contents buffer

let element name inside = Element (name, [], inside)

(* Each on a line of its own. *)
let lined elements = List.concat_map (fun e -> [ Data "\n"; e ]) elements @ [ Data "\n" ]
let text name data = Element (name, [], [ Data data ])
let property_text : property -> string = function Text text -> text | Number x -> number x

let kml ~title features =
  let coordinates (p : Position.t) = [ degrees p.longitude; degrees p.latitude; metres p.height ] in
  let listed positions = String.concat " " (List.map (fun p -> String.concat "," (coordinates p)) positions) in
  let track part =
    element "gx:Track"
      (List.map (fun s -> text "when" (utc s.time)) part
       @ List.map (fun s -> text "gx:coord" (String.concat " " (coordinates s.position))) part)
  in
  let geometry = function
    | Point p -> element "Point" [ text "coordinates" (listed [ p ]) ]
    | Line line -> element "LineString" [ text "tessellate" "1"; text "coordinates" (listed line) ]
    | Track parts -> element "gx:MultiTrack" (text "gx:interpolate" "0" :: List.map track parts)
  in
  let placemark f =
    let data (name, x) = Element ("Data", [ ("name", name) ], [ text "value" (property_text x) ]) in
    element "Placemark"
      [ text "name" f.name; element "ExtendedData" (List.map data f.properties); geometry f.geometry ]
  in
  let names = [ ("xmlns", "http://www.opengis.net/kml/2.2"); ("xmlns:gx", "http://www.google.com/kml/ext/2.2") ] in
  document (Element ("kml", names, [ element "Document" (lined (text "name" title :: List.map placemark features)) ]))

let gpx ~title features =
  let point ?time kind (p : Position.t) inside =
    let at = [ ("lat", degrees p.latitude); ("lon", degrees p.longitude) ] in
    let time = match time with Some time -> [ text "time" (utc time) ] | None -> [] in
    Element (kind, at, (text "ele" (metres p.height) :: time) @ inside)
  in
  let described f =
    let property (name, x) = Printf.sprintf "%s: %s" name (property_text x) in
    text "name" f.name
    :: (if f.properties = [] then [] else [ text "desc" (String.concat "; " (List.map property f.properties)) ])
  in
  let point_of f = match f.geometry with Point p -> Some (point "wpt" p (described f)) | Line _ | Track _ -> None in
  let route_of f =
    match f.geometry with
    | Line line -> Some (element "rte" (described f @ List.map (fun p -> point "rtept" p []) line))
    | Point _ | Track _ -> None
  in
  let track_of f =
    match f.geometry with
    | Track parts ->
      let part samples =
        element "trkseg" (List.map (fun s -> point ~time:s.time "trkpt" s.position []) samples) in
      Some (element "trk" (described f @ List.map part parts))
    | Point _ | Line _ -> None
  in
  (* In the order that the format wants. *)
  let all = List.concat_map (fun kind -> List.filter_map kind features) [ point_of; route_of; track_of ] in
  let names = [ ("version", "1.1"); ("creator", "Dolphin"); ("xmlns", "http://www.topografix.com/GPX/1/1") ] in
  document (Element ("gpx", names, lined (element "metadata" [ text "name" title ] :: all)))

(* {1 CSV} *)

let csv columns rows =
  let is_special c = c = ',' || c = '"' || c = '\n' || c = '\r' in
  let quoted text =
    if not (String.exists is_special text) then text
    else "\"" ^ String.concat "\"\"" (String.split_on_char '"' text) ^ "\"" in
  let row cells = String.concat "," (List.map quoted cells) ^ "\r\n" in
  String.concat "" (row columns :: List.map (fun cells -> row (List.map property_text cells)) rows)
