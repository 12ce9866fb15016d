open Dolphin_maps

(* The grammars as regular expressions; the readers have scanners of their own. *)
let matches expression =
  let whole = Str.regexp (expression ^ "$") in
  fun text -> Str.string_match whole text 0

let decimal = {|[+-]?\([0-9]+\(\.[0-9]*\)?\|\.[0-9]+\)|}
let power = {|\([eE][+-]?[0-9]+\)?|}

(* xsd:double without INF and NaN, which are no coordinates. *)
let is_double = matches (decimal ^ power)
let is_json = matches ({|-?\(0\|[1-9][0-9]*\)\(\.[0-9]+\)?|} ^ power)
let is_decimal = matches decimal

type format = { path : string; of_latitude : string -> string; is_number : string -> bool }

let xml root inside = Printf.sprintf "<%s>%s</%s>" root inside root

let formats =
  let kml x = xml "kml" (xml "Placemark" (xml "Point" (xml "coordinates" ("1," ^ x)))) in
  let gpx x = xml "gpx" (Printf.sprintf "<wpt lat='%s' lon='1'/>" x) in
  let geojson x = Printf.sprintf {|{"type":"Point","coordinates":[1,%s]}|} x in
  let plan x = Printf.sprintf {|{"fileType":"Plan","mission":{"plannedHomePosition":[%s,1,0]}}|} x in
  let neptus x =
    let coordinate = xml "coordinate" (xml "latitude" x ^ xml "longitude" "1") in
    xml "map" (xml "features" (xml "mark" (xml "id" "m" ^ coordinate))) in
  let archived x = Damage.archive [ ("m.nmap", neptus x) ] in
  [ { path = "m.kml"; of_latitude = kml; is_number = is_double };
    { path = "m.kmz"; of_latitude = (fun x -> Damage.archive [ ("doc.kml", kml x) ]); is_number = is_double };
    { path = "m.gpx"; of_latitude = gpx; is_number = is_double };
    { path = "m.geojson"; of_latitude = geojson; is_number = is_json };
    { path = "m.plan"; of_latitude = plan; is_number = is_json };
    { path = "m.nmap"; of_latitude = neptus; is_number = is_double };
    { path = "m.nmisz"; of_latitude = archived; is_number = is_double } ]

let strange =
  [ "0x29"; "-8_7"; "4_1"; "1_0"; "1e999"; "-1e999"; "nan"; "NaN"; "inf"; "-inf"; "INF"; "Infinity"; "-Infinity"; "0b1";
    "0o7"; "1.5e"; "+5"; ".5"; "5."; "1e1"; "-.5e-1"; "05"; "-0"; "--5"; "+-5"; "."; "-"; "e1"; "1e+"; "0x1p3"; "5f"; "5d";
    "1.2.3"; "1e1.5"; "0x"; "1_"; "_1"; "90"; "91"; "-90.0000001"; "1E-400"; "null"; "true" ]

let spelling =
  let open QCheck2.Gen in
  let character = oneofl [ '0'; '1'; '7'; '9'; '-'; '+'; '.'; 'e'; 'E'; '_'; 'x'; 'b' ] in
  oneof [ oneofl strange; string_size ~gen:character (int_range 1 6) ]

let found { path; of_latitude; _ } text =
  match Map_file.read ~path (of_latitude text) with
  | Ok { things = [ (_, Ok (Point p)) ]; notes } -> Some (p.latitude, notes)
  | Ok _ | Error _ -> None

(* GPX has decimals, but some writers of it give small numbers a power of ten: they are read with a note. *)
let expected { path; is_number; _ } text =
  let value = if is_number text then float_of_string text else Float.infinity in
  let notes =
    if path = "m.gpx" && not (is_decimal text) then
      [ Printf.sprintf "line 1: '%s' is read, although GPX does not allow a power of ten" text ]
    else [] in
  if Float.abs value <= 90. then Some (value, notes) else None

let is_by_grammar (format, text) = found format text = expected format text

let drawn =
  Test_support.Property.case ~count:3000 "numbers by the format's grammar"
    QCheck2.Gen.(pair (oneofl formats) spelling) ~print:(fun (format, text) -> format.path ^ ": " ^ text) is_by_grammar

let all () =
  let one format text =
    if not (is_by_grammar (format, text)) then Alcotest.failf "%s: '%s' is read against the grammar" format.path text in
  List.iter (fun format -> List.iter (one format) strange) formats

let cases = [ Alcotest.test_case "strange numbers in each format" `Quick all; drawn ]
