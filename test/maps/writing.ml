open Dolphin_geo
open Dolphin_maps
open Shown

let times () =
  check "whole" "2026-03-01T12:00:00Z" (Feature.utc 1772366400.);
  check "with milliseconds" "2026-03-01T12:00:00.040Z" (Feature.utc 1772366400.04);
  check "rounded up" "2026-03-01T12:00:01Z" (Feature.utc 1772366400.9996);
  check "before 1970" "1969-12-31T23:59:59.500Z" (Feature.utc (-0.5))

let cutting () =
  let shown line =
    let position (p : Position.t) = Printf.sprintf "%g %g" p.latitude p.longitude in
    String.concat " | " (List.map (fun part -> String.concat ", " (List.map position part)) (Feature.parts line))
  in
  check "nothing to cut" "1 2, 3 4" (shown [ at 1. 2.; at 3. 4. ]);
  check "eastwards" "0 179, 1 180 | 1 -180, 2 -179" (shown [ at 0. 179.; at 2. (-179.) ]);
  check "westwards and back" "0 -178, 1 -180 | 1 180, 2 178, 3 180 | 3 -180, 4 -178"
    (shown [ at 0. (-178.); at 2. 178.; at 4. (-178.) ]);
  check "on the meridian itself" "0 180 | 0 -180, 1 -179" (shown [ at 0. 180.; at 1. (-179.) ])

let sample time latitude : Feature.sample = { time; position = at latitude (-8.7) }

let features : Feature.t list =
  [ { name = "a \"b\" <c> & d\001"; geometry = Point (at ~height:2.5 41. (-8.123456789));
      properties = [ ("n", Number 1.5); ("t", Text "x") ] };
    { name = "way"; geometry = Line [ at 41. (-8.); at 42. (-9.) ]; properties = [] };
    { name = "v"; geometry = Track [ [ sample 0. 41.; sample 1.5 42. ]; [ sample 9. 43. ] ]; properties = [] } ]

let geojson () =
  check "features"
    {|{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"name":"a \"b\" <c> & d\u0001","n":1.5,"t":"x"},"geometry":{"type":"Point","coordinates":[-8.12345679,41,2.5]}},
{"type":"Feature","properties":{"name":"way"},"geometry":{"type":"LineString","coordinates":[[-8,41,0],[-9,42,0]]}},
{"type":"Feature","properties":{"name":"v","coordTimes":[["1970-01-01T00:00:00Z","1970-01-01T00:00:01.500Z"],["1970-01-01T00:00:09Z","1970-01-01T00:00:09Z"]]},"geometry":{"type":"MultiLineString","coordinates":[[[-8.7,41,0],[-8.7,42,0]],[[-8.7,43,0],[-8.7,43,0]]]}}
]}
|}
    (Map_text.geojson features);
  check "none" "{\"type\":\"FeatureCollection\",\"features\":[\n\n]}\n" (Map_text.geojson [])

let xml () =
  check "gpx"
    {|<?xml version="1.0" encoding="UTF-8"?>
<gpx version="1.1" creator="Dolphin" xmlns="http://www.topografix.com/GPX/1/1">
<metadata><name>m</name></metadata>
<wpt lat="41" lon="-8.12345679"><ele>2.5</ele><name>a &quot;b&quot; &lt;c&gt; &amp; d </name><desc>n: 1.5; t: x</desc></wpt>
<rte><name>way</name><rtept lat="41" lon="-8"><ele>0</ele></rtept><rtept lat="42" lon="-9"><ele>0</ele></rtept></rte>
<trk><name>v</name><trkseg><trkpt lat="41" lon="-8.7"><ele>0</ele><time>1970-01-01T00:00:00Z</time></trkpt><trkpt lat="42" lon="-8.7"><ele>0</ele><time>1970-01-01T00:00:01.500Z</time></trkpt></trkseg><trkseg><trkpt lat="43" lon="-8.7"><ele>0</ele><time>1970-01-01T00:00:09Z</time></trkpt></trkseg></trk>
</gpx>
|}
    (Map_text.gpx ~title:"m" features);
  check "kml"
    ({|<?xml version="1.0" encoding="UTF-8"?>
<kml xmlns="http://www.opengis.net/kml/2.2" xmlns:gx="http://www.google.com/kml/ext/2.2"><Document>
<name>m</name>
<Placemark><name>way</name><ExtendedData/>|} ^ {|<LineString><tessellate>1</tessellate><coordinates>-8,41,0 -9,42,0</coordinates></LineString></Placemark>
</Document></kml>
|})
    (Map_text.kml ~title:"m" [ List.nth features 1 ])

(* Names of files and properties may be any bytes. *)
let any_names =
  let part =
    QCheck2.Gen.oneofl
      [ "a"; "\000"; "\027"; "\n"; "\t"; "<"; "&"; "]]>"; "\xff"; "\xc2\x80"; "\xed\xa0\x80"; "\xef\xbf\xbe"; "\xef\xbf\xbf";
        "\xe2\x80\xae"; "\xf0\x9f\x90\xac" ] in
  let name = QCheck2.Gen.(map (String.concat "") (list_size (int_bound 6) part)) in
  let is_well_formed text =
    let input = Xmlm.make_input (`String (0, text)) in
    let rec read () = Xmlm.eoi input || (ignore (Xmlm.input input); read ()) in
    match read () with read -> read | exception Xmlm.Error (_, error) -> failwith (Xmlm.error_message error)
  in
  let agrees name =
    let all = List.map (fun (f : Feature.t) -> { f with name; properties = [ ("p", Feature.Text name) ] }) features in
    is_well_formed (Map_text.gpx ~title:name all) && is_well_formed (Map_text.kml ~title:name all)
  in
  Test_support.Property.case ~count:500 "any names in XML" ~print:(Printf.sprintf "%S") name agrees

let csv () =
  check "quotes" "a,b\r\n\"x,\"\"y\"\"\",0.25\r\n" (Map_text.csv [ "a"; "b" ] [ [ Text "x,\"y\""; Number 0.25 ] ])

(* A long journal: nothing here recurs once for each sample. *)
let long_tracks () =
  let samples = List.init 200_000 (fun i -> sample (float_of_int i) (float_of_int i /. 1e5)) in
  let track : Feature.t = { name = "v"; geometry = Track [ samples ]; properties = [] } in
  let lengths = List.map String.length [ Map_text.geojson [ track ]; Map_text.kml ~title:"" [ track ] ] in
  Alcotest.(check bool) "all are written" true (List.for_all (fun n -> n > 200_000 * 20) lengths)

let cases =
  [ case "times" times;
    case "the meridian of 180 degrees" cutting;
    case "GeoJSON" geojson;
    case "XML" xml;
    any_names;
    case "CSV" csv;
    case "long tracks" long_tracks ]
