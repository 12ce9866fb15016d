open Dolphin_geo
open Dolphin_maps

let at ?(height = 0.) latitude longitude : Position.t = { latitude; longitude; height }
let case name run = Alcotest.test_case name `Quick run
let check = Alcotest.(check string)

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

let csv () =
  check "quotes" "a,b\r\n\"x,\"\"y\"\"\",0.25\r\n" (Map_text.csv [ "a"; "b" ] [ [ Text "x,\"y\""; Number 0.25 ] ])

(* A long journal: nothing here recurs once for each sample. *)
let long_tracks () =
  let samples = List.init 200_000 (fun i -> sample (float_of_int i) (float_of_int i /. 1e5)) in
  let track : Feature.t = { name = "v"; geometry = Track [ samples ]; properties = [] } in
  let lengths = List.map String.length [ Map_text.geojson [ track ]; Map_text.kml ~title:"" [ track ] ] in
  Alcotest.(check bool) "all are written" true (List.for_all (fun n -> n > 200_000 * 20) lengths)

(* {1 Reading} *)

let shown path text =
  match Map_file.read ~path text with
  | Error why -> "wrong: " ^ why
  | Ok { things; notes } ->
    let one (name, thing) =
      match (thing : (Map_file.thing, string) result) with
      | Error why -> Printf.sprintf "%s: flawed: %s" name why
      | Ok (Point p) -> Format.asprintf "%s: %a" name Position.pp p
      | Ok (Line ps) -> Printf.sprintf "%s: line of %d" name (List.length ps)
      | Ok (Area area) -> Printf.sprintf "%s: %.0f m2, %d corners" name (Area.size area) (List.length (Area.corners area))
    in
    String.concat "; " (List.map one things @ List.map (fun note -> "note: " ^ note) notes)

let feature ?(properties = {|{"name":"a"}|}) kind coordinates =
  Printf.sprintf {|{"type":"Feature","properties":%s,"geometry":{"type":"%s","coordinates":%s}}|} properties kind
    coordinates

let collection features =
  Printf.sprintf {|{"type":"FeatureCollection","features":[%s]}|} (String.concat "," features)

let square = "[[0,0],[0.001,0],[0.001,0.001],[0,0.001],[0,0]]"

let reading_geojson () =
  let read features = shown "m.geojson" (collection features) in
  check "a point" "a: (41.000000, -8.000000, 2.0 m)" (read [ feature "Point" "[-8,41,2]" ]);
  check "a line" "a: line of 2" (read [ feature "LineString" "[[-8,41],[-8.1,41]]" ]);
  check "a polygon" "a: 12309 m2, 4 corners" (read [ feature "Polygon" (Printf.sprintf "[%s]" square) ]);
  check "with a hole" "a: 9232 m2, 8 corners"
    (read
       [ feature "Polygon"
           (Printf.sprintf "[%s,[[0.0002,0.0002],[0.0007,0.0002],[0.0007,0.0007],[0.0002,0.0007],[0.0002,0.0002]]]"
              square) ]);
  check "several" "a: 24618 m2, 8 corners"
    (read
       [ feature "MultiPolygon"
           (Printf.sprintf "[[%s],[[[0.002,0],[0.003,0],[0.003,0.001],[0.002,0.001],[0.002,0]]]]" square) ]);
  check "over the meridian of 180 degrees" "a: 24618 m2, 4 corners"
    (read [ feature "Polygon" "[[[179.999,0],[-179.999,0],[-179.999,0.001],[179.999,0.001],[179.999,0]]]" ]);
  check "names" "a: (0.000000, 1.000000); a 2: (0.000000, 2.000000); point 1: (0.000000, 3.000000); \
                 7: (0.000000, 4.000000); point 2: (0.000000, 5.000000); a 3: (0.000000, 6.000000)"
    (read
       [ feature "Point" "[1,0]"; feature "Point" "[2,0]"; feature ~properties:"null" "Point" "[3,0]";
         feature ~properties:{|{"title":7}|} "Point" "[4,0]"; feature ~properties:{|{"name":" \n"}|} "Point" "[5,0]";
         feature "Point" "[6,0]" ]);
  check "a name that is like a made one" "a 2: (0.000000, 1.000000); a: (0.000000, 2.000000); a 3: (0.000000, 3.000000)"
    (read
       [ feature ~properties:{|{"name":"a 2"}|} "Point" "[1,0]"; feature "Point" "[2,0]"; feature "Point" "[3,0]" ]);
  check "a made name that is taken" "point 1: (0.000000, 1.000000); point 2: (0.000000, 2.000000)"
    (read [ feature ~properties:{|{"name":"point 1"}|} "Point" "[1,0]"; feature ~properties:"{}" "Point" "[2,0]" ]);
  check "a name of another that a made one would be"
    "zone: (0.000000, 1.000000); zone 3: (0.000000, 2.000000); zone 2: (0.000000, 3.000000); point 1: (0.000000, \
     4.000000); point 2: (0.000000, 5.000000)"
    (read
       (List.mapi
          (fun i name ->
             feature ~properties:(Printf.sprintf {|{"name":"%s"}|} name) "Point" (Printf.sprintf "[%d,0]" (i + 1)))
          [ "zone"; "zone"; "zone 2"; "point 1"; "" ]));
  check "no geometry" "note: feature 1: it has no geometry, and is left out" (read [ {|{"type":"Feature","properties":{},"geometry":null}|} ]);
  check "a bare geometry" "point 1: (2.000000, 1.000000)" (shown "m.json" {|{"type":"Point","coordinates":[1,2]}|})

let wrong_geojson () =
  let read text = shown "M.GeoJSON" text in
  let told features = read (collection features) in
  (* In the words of the library, which differ from one release to the next. *)
  let begins_with start text = check start start (String.sub text 0 (min (String.length start) (String.length text))) in
  begins_with "wrong: line 2, bytes " (read "[1\n }");
  begins_with "wrong: line 1, bytes " (read "[1, 2");
  check "something else" "wrong: this is no GeoJSON: it has no \"type\": \"FeatureCollection\"" (read "[1]");
  check "a geometry that is none"
    "a: (2.000000, 1.000000); a 2: flawed: feature 2 ('a'): GeoJSON has no geometry 'Circle'"
    (told [ feature "Point" "[1,2]"; feature "Circle" "[1,2]" ]);
  check "a latitude" "wrong: feature 1 ('a'): latitude 91 is not from -90 to 90 degrees"
    (told [ feature "Point" "[1,91]" ]);
  check "a position in a line" "wrong: feature 1 ('a'), position 2: longitude 181 is not from -180 to 180 degrees"
    (told [ feature "LineString" "[[1,2],[181,2]]" ]);
  check "no number" "wrong: feature 1 ('a'): a number belongs here" (told [ feature "Point" {|["x",2]|} ]);
  check "a line of one" "wrong: feature 1 ('a'): a line has two positions at least"
    (told [ feature "LineString" "[[1,2]]" ]);
  check "a bow tie" "wrong: feature 1 ('a'): a polygon does not cross itself: its sides from corner 1 and from corner 3 meet"
    (told [ feature "Polygon" "[[[0,0],[0.01,0.01],[0.01,0],[0,0.01],[0,0]]]" ]);
  check "another ending" "wrong: a map ends in .geojson, .json, .kml, .kmz, .gpx, .plan, .nmap, .nmisz"
    (shown "m.txt" "");
  check "too long" "wrong: it has more than 20 MB" (read (String.make (Map_file.most_bytes + 1) ' '))

let empty_geometries () =
  let read features = shown "m.geojson" (collection (features @ [ feature ~properties:"{}" "Point" "[1,0]" ])) in
  let left_out = "point 1: (0.000000, 1.000000); note: feature 1 ('a'): it is empty, and left out" in
  List.iter
    (fun (kind, coordinates) -> check (kind ^ " " ^ coordinates) left_out (read [ feature kind coordinates ]))
    [ ("Point", "[]"); ("MultiPoint", "[]"); ("LineString", "[]"); ("MultiLineString", "[[]]"); ("Polygon", "[]");
      ("Polygon", "[[]]"); ("MultiPolygon", "[]"); ("MultiPolygon", "[[[]]]") ];
  check "an empty collection" left_out
    (read [ {|{"type":"Feature","properties":{"name":"a"},"geometry":{"type":"GeometryCollection","geometries":[]}}|} ]);
  check "an empty part" "a: (0.000000, 2.000000); point 1: (0.000000, 1.000000)"
    (read [ feature "MultiPoint" "[[],[2,0]]" ]);
  check "an empty hole" "a: 12309 m2, 4 corners; point 1: (0.000000, 1.000000)"
    (read [ feature "Polygon" (Printf.sprintf "[%s,[]]" square) ]);
  let kml inside = shown "m.kml" ("<kml><Placemark><name>a</name>" ^ inside ^ "</Placemark></kml>") in
  let note = "note: line 1 ('a'): it is empty, and left out" in
  check "KML: a point" note (kml "<Point><coordinates/></Point>");
  check "KML: a line" note (kml "<LineString><coordinates> </coordinates></LineString>");
  check "KML: a ring" note
    (kml "<Polygon><outerBoundaryIs><LinearRing><coordinates/></LinearRing></outerBoundaryIs></Polygon>");
  check "GPX" note (shown "m.gpx" "<gpx><rte><name>a</name></rte></gpx>")

let bad_features () =
  let read bad = shown "m.geojson" (collection [ bad; feature ~properties:{|{"name":"b"}|} "Point" "[1,0]" ]) in
  let b = "; b: (0.000000, 1.000000)" in
  check "a bow tie" ("a: flawed: feature 1 ('a'): a polygon does not cross itself: its sides from corner 1 and from \
                      corner 3 meet" ^ b)
    (read (feature "Polygon" "[[[0,0],[0.01,0.01],[0.01,0],[0,0.01],[0,0]]]"));
  check "too wide" ("a: flawed: feature 1 ('a'): an area reaches at most 200 km from its middle" ^ b)
    (read (feature "Polygon" "[[[0,0],[9,0],[9,9],[0,0]]]"));
  check "a number" ("a: flawed: feature 1 ('a'): a number of that size or kind is not known" ^ b)
    (read (feature "Point" "[1e999,0]"));
  check "a control character in its kind" ("a: flawed: feature 1 ('a'): GeoJSON has no geometry ' [2J'" ^ b)
    (read (feature {|\u001b[2J|} "[1,0]"));
  check "without a name"
    ("feature 1: flawed: feature 1: latitude 91 is not from -90 to 90 degrees; point 1: (0.000000, 1.000000)")
    (shown "m.geojson"
       (collection [ feature ~properties:"{}" "Point" "[1,91]"; feature ~properties:"{}" "Point" "[1,0]" ]));
  check "GPX" "feature 1: flawed: line 1: '0x29' is no number; point 1: (1.000000, 2.000000)"
    (shown "m.gpx" "<gpx><wpt lat='0x29' lon='-8_7'/><wpt lat='1' lon='2'/></gpx>");
  check "KML" "a: flawed: line 1: '4_1' is no number; b: (1.000000, 2.000000)"
    (shown "m.kml"
       "<kml><Placemark><name>a</name><Point><coordinates>-8,4_1</coordinates></Point></Placemark>\
        <Placemark><name>b</name><Point><coordinates>2,1</coordinates></Point></Placemark></kml>")

let repaired () =
  let read rings = shown "m.geojson" (collection [ feature "Polygon" (Printf.sprintf "[%s]" rings) ]) in
  let a = "a: 12309 m2, 4 corners" and note = "; note: feature 1 ('a'): " in
  check "a ring that nearly closes" a (read "[[0,0],[0.001,0],[0.001,0.001],[0,0.001],[0.000000003,0.000000003]]");
  check "a spike" (a ^ note ^ "spikes are cut off, corners that repeat the one before are left out")
    (read "[[0,0],[0.001,0],[0.002,0],[0.001,0],[0.001,0.001],[0,0.001],[0,0]]");
  check "a spike where the ring closes" (a ^ note ^ "spikes are cut off, corners that repeat the one before are left out")
    (read "[[0,0.003],[0,0.001],[0,0],[0.001,0],[0.001,0.001],[0,0.001],[0,0.003]]");
  check "a spike with two sides" (a ^ note ^ "spikes are cut off, corners that repeat the one before are left out")
    (read "[[0,0],[0.001,0],[0.0012,0.0005],[0.001,0.0000000001],[0.001,0.001],[0,0.001],[0,0]]");
  check "a corner twice within a millimetre" (a ^ note ^ "corners that repeat the one before are left out")
    (read "[[0,0],[0.001,0],[0.001,0.00000000001],[0.001,0.001],[0,0.001],[0,0]]");
  check "a rim that touches itself"
    ("a: 24618 m2, 8 corners" ^ note ^ "the rim touches or crosses itself slightly, and is cut there")
    (read "[[0,0],[0.001,0],[0.001,0.001],[0.002,0.001],[0.002,0.002],[0.001,0.002],[0.001,0.001],[0,0.001],[0,0]]");
  let hole x = Printf.sprintf "[[%g,0.0002],[%g,0.0002],[%g,0.0007],[%g,0.0007]]" x (x +. 0.0002) (x +. 0.0002) x in
  check "a hole that touches the rim" "a: 11078 m2, 8 corners" (read (square ^ "," ^ hole 0.));
  check "holes beside each other" "a: 9847 m2, 12 corners" (read (square ^ "," ^ hole 0.0002 ^ "," ^ hole 0.0004));
  let cut_off = note ^ "holes that meet or reach out of the polygon are united and cut off" in
  check "holes that overlap slightly" ("a: 9853 m2, 8 corners" ^ cut_off)
    (read (square ^ "," ^ hole 0.0002 ^ "," ^ hole 0.000399));
  check "a hole that reaches out slightly" ("a: 11084 m2, 8 corners" ^ cut_off)
    (read (square ^ "," ^ hole (-0.000001)));
  let outside i = Printf.sprintf "wrong: feature 1 ('a'): hole %d is not inside of the polygon, or meets another hole" i in
  check "holes that overlap" (outside 2) (read (square ^ "," ^ hole 0.0002 ^ "," ^ hole 0.0003));
  check "a hole that reaches out" (outside 1) (read (square ^ "," ^ hole (-0.0001)));
  check "the rim and the hole are exchanged" (outside 1)
    (read (Printf.sprintf "%s,%s" (hole 0.0002) square));
  check "a hole without extent" (a ^ note ^ "holes without extent are left out")
    (read (square ^ ",[[0.0002,0.0002],[0.0002,0.0005],[0.0002,0.0002]]"));
  let many = List.init 12_000 (fun i ->
      let angle = Float.pi *. float_of_int i /. 6000. in
      Printf.sprintf "[%.9f,%.9f]" (0.01 *. cos angle) (0.01 *. sin angle)) in
  check "many corners" "a: 3867009 m2, 12000 corners" (read (Printf.sprintf "[%s]" (String.concat "," many)))

let coordinate_systems () =
  let with_crs crs = Printf.sprintf {|{"type":"FeatureCollection","crs":%s,"features":[%s]}|} crs (feature "Point" "[2,1]") in
  let named name = with_crs (Printf.sprintf {|{"type":"name","properties":{"name":"%s"}}|} name) in
  let read text = shown "m.geojson" text in
  List.iter
    (fun name -> check name "a: (1.000000, 2.000000)" (read (named name)))
    [ "urn:ogc:def:crs:OGC:1.3:CRS84"; "urn:ogc:def:crs:OGC::CRS84"; "EPSG:4326"; "urn:ogc:def:crs:EPSG::4326"; "epsg:4326";
      "http://www.opengis.net/def/crs/OGC/1.3/CRS84"; "http://www.opengis.net/def/crs/EPSG/0/4326"; "WGS84" ];
  List.iter
    (fun name ->
       check name
         (Printf.sprintf
            "wrong: its coordinates are in the system %s: they have to be in WGS 84, longitude first (EPSG:4326)" name)
         (read (named name)))
    [ "urn:ogc:def:crs:EPSG::3857"; "EPSG:32629"; "EPSG:14326"; "IAU:4326"; "" ];
  check "none" "a: (1.000000, 2.000000)" (read (with_crs "null"));
  check "a code" "a: (1.000000, 2.000000)" (read (with_crs {|{"type":"EPSG","properties":{"code":4326}}|}));
  check "another code"
    "wrong: its coordinates are in the system EPSG:3763: they have to be in WGS 84, longitude first (EPSG:4326)"
    (read (with_crs {|{"type":"EPSG","properties":{"code":3763}}|}));
  check "a link"
    "wrong: its coordinates are in the system of a crs that names none: they have to be in WGS 84, longitude first \
     (EPSG:4326)"
    (read (with_crs {|{"type":"link","properties":{"href":"a"}}|}))

let encodings () =
  let geojson name = collection [ feature ~properties:(Printf.sprintf {|{"name":"%s"}|} name) "Point" "[1,0]" ] in
  let place = ": (0.000000, 1.000000)" in
  check "a byte order mark" ("a" ^ place) (shown "m.geojson" ("\xef\xbb\xbf" ^ geojson "a"));
  check "Latin-1 in JSON" ("Leix\xef\xbf\xbdes" ^ place ^ "; note: 1 byte is not UTF-8, and read as U+FFFD")
    (shown "m.geojson" (geojson "Leix\xf5es"));
  check "a name of controls" ("a b" ^ place) (shown "m.geojson" (geojson {|a\u001bb\u0085|}));
  let gpx head name =
    shown "m.gpx" (Printf.sprintf "%s<gpx><wpt lat='0' lon='1'><name>%s</name></wpt></gpx>" head name) in
  check "windows-1252" ("\xe2\x82\xac Leix\xc3\xb5es" ^ place)
    (gpx "<?xml version=\"1.0\" encoding=\"windows-1252\"?>" "\x80 Leix\xf5es");
  check "windows-1252, in capitals" ("\xe2\x80\x99" ^ place) (gpx "<?xml version='1.0' encoding='Windows-1252'?>" "\x92");
  check "ISO 8859-1" ("Leix\xc3\xb5es" ^ place) (gpx "<?xml version='1.0' encoding='ISO-8859-1'?>" "Leix\xf5es");
  check "a byte order mark before XML" ("a" ^ place) (gpx "\xef\xbb\xbf<?xml version='1.0'?>" "a");
  check "not UTF-8" "wrong" (String.sub (gpx "" "\xf5") 0 5)

let reading_kml () =
  let read inside = shown "m.kml" (Printf.sprintf "<kml xmlns='k'><Document>%s</Document></kml>" inside) in
  let ring = "<LinearRing><coordinates>0,0 0.001,0 0.001,0.001 0,0.001 0,0</coordinates></LinearRing>" in
  let placed name geometry = Printf.sprintf "<Placemark><name>%s</name>%s</Placemark>" name geometry in
  check "in folders" "p &: (41.000000, -8.000000, 3.0 m)"
    (read ("<Folder><Folder>" ^ placed "p &amp;" "<Point><coordinates>\n -8,41,3\n</coordinates></Point>"
           ^ "</Folder></Folder>"));
  check "polygons of one place" "a: 12309 m2, 4 corners; a 2: line of 2"
    (read
       (placed "a"
          ("<MultiGeometry><Polygon><outerBoundaryIs>" ^ ring ^ "</outerBoundaryIs></Polygon><LineString>"
           ^ "<coordinates>0,0 1,1</coordinates></LineString></MultiGeometry>")));
  check "a track" "t: line of 2"
    (read (placed "t" "<gx:Track><when/><gx:coord>1 2 3</gx:coord><gx:coord>1 3 3</gx:coord></gx:Track>"));
  check "what has no place" "" (read (placed "n" "" ^ "<Style/>"));
  let polygon = "<Polygon><outerBoundaryIs>" ^ ring ^ "</outerBoundaryIs></Polygon>" in
  check "MultiPolygon" "a: 12309 m2, 4 corners" (read (placed "a" ("<MultiPolygon>" ^ polygon ^ "</MultiPolygon>")));
  check "a geometry that is not known" "note: line 1 ('a'): Circle is not known here, and left out"
    (read (placed "a" "<Circle><coordinates>0,0</coordinates></Circle>"));
  check "a link" "note: line 1 ('n'): the link to 'http://example.org/a.kml' is not followed, and left out"
    (read "<NetworkLink><name>n</name><Link><href>http://example.org/a.kml</href></Link></NetworkLink>");
  check "no number" "wrong: line 3: 'x' is no number"
    (read (placed "p\n\n" "<Point><coordinates>-8,x\n\n</coordinates></Point>"));
  check "no coordinates" "wrong: line 1: Point has no coordinates" (read (placed "p" "<Point/>"));
  check "another document" "wrong: line 1: this is no KML: its root is 'gpx'" (shown "m.kml" "<gpx/>");
  check "no XML" "wrong: line 2, column 2: this is no XML: expected root element" (shown "m.kml" "<!-- -->\n nothing")

let reading_gpx () =
  let read inside = shown "m.gpx" ("<gpx>" ^ inside ^ "</gpx>") in
  check "all" "w: (41.000000, -8.000000, 5.0 m); r: line of 2; t: line of 2; t 2: (1.000000, 3.000000)"
    (read
       "<metadata/><wpt lat='41' lon='-8'><ele>5</ele><name>w</name></wpt>\
        <rte><name>r</name><rtept lat='1' lon='1'/><rtept lat='1' lon='2'/></rte>\
        <trk><name>t</name><trkseg><trkpt lat='1' lon='1'/><trkpt lat='1' lon='2'/></trkseg>\
        <trkseg><trkpt lat='1' lon='3'/></trkseg><trkseg/></trk>");
  check "no longitude" "wrong: line 1: a point has the attributes lat and lon" (read "<wpt lat='1'/>")

let reading_plans () =
  let plan =
    {|{"fileType":"Plan","mission":{"plannedHomePosition":[41,-8,10],"items":[
      {"type":"SimpleItem","command":16,"params":[0,0,0,null,41.1,-8,30]},
      {"type":"SimpleItem","command":20,"params":[0,0,0,0,0,0,0]},
      {"type":"SimpleItem","command":16,"params":[0,0,0,null,41.2,-8,30]},
      {"type":"ComplexItem","complexItemType":"survey","polygon":[[0,0],[0,0.001],[0.001,0.001],[0.001,0]]},
      {"type":"ComplexItem","complexItemType":"CorridorScan","polyline":[[0,0],[0,1]]}]},
      "geoFence":{"circles":[{"inclusion":false,"circle":{"center":[41,-8],"radius":100}}],
      "polygons":[{"inclusion":true,"polygon":[[0,0],[0,0.001],[0.001,0.001],[0.001,0]]}]},
      "rallyPoints":{"points":[[41,-8,50]]}}|}
  in
  check "QGroundControl" "home: (41.000000, -8.000000, 10.0 m); mission: line of 2; survey 1: 12309 m2, 4 corners; \
                          corridor 1: line of 2; inside 1: 12309 m2, 4 corners; outside 1: 31416 m2, 128 corners; \
                          rally 1: (41.000000, -8.000000, 50.0 m)"
    (shown "m.plan" plan);
  check "a radius" "wrong: circle 1 of the fence: a radius is 0 m or more, not -1"
    (shown "m.plan" {|{"fileType":"Plan","geoFence":{"circles":[{"circle":{"center":[41,-8],"radius":-1}}]}}|});
  check "another file" "wrong: this is no plan of QGroundControl: it has no \"fileType\": \"Plan\"" (shown "m.plan" "{}")

(* Commands with a place that is not flown to, in frames that have no place on the globe, and landing patterns. *)
let missions () =
  let item ?(frame = 3) command place =
    Printf.sprintf {|{"type":"SimpleItem","command":%d,"frame":%d,"params":[0,0,0,null,%s]}|} command frame place in
  let plan items = Printf.sprintf {|{"fileType":"Plan","mission":{"items":[%s]}}|} (String.concat "," items) in
  let read items = shown "m.plan" (plan items) in
  let first = item 22 "41,-8,30" and second = item 16 "42,-8,30" in
  let two = "mission: line of 2" in
  check "two" two (read [ first; second ]);
  List.iter
    (fun command -> check (string_of_int command) two (read [ first; item command "43,-7,0"; second ]))
    [ 80; 179; 189; 195; 196; 197; 201; 203; 206; 4501; 2000 ];
  List.iter
    (fun command -> check (string_of_int command) "mission: line of 3" (read [ first; item command "43,-7,0"; second ]))
    [ 16; 17; 18; 19; 21; 22; 31; 82; 84; 85 ];
  List.iter
    (fun frame -> check (Printf.sprintf "frame %d" frame) "mission: line of 3"
        (read [ first; item ~frame 16 "43,-7,0"; second ]))
    [ 0; 3; 5; 6; 10; 11 ];
  check "a local frame" (two ^ "; note: item 2 of the mission: WAYPOINT in frame 1 has no place on the globe, and left out")
    (read [ first; item ~frame:1 16 "43,-7,0"; second ]);
  check "a place that is none"
    "mission: flawed: item 2 of the mission: latitude 91 is not from -90 to 90 degrees; survey 1: line of 2"
    (read [ first; item 16 "91,0,0"; {|{"type":"ComplexItem","polyline":[[0,0],[1,1]]}|} ]);
  check "a landing pattern"
    (two ^ "; note: item 2 of the mission: the landing pattern (fwLandingPattern) has no place on the map, and left out")
    (read [ first; {|{"type":"ComplexItem","complexItemType":"fwLandingPattern"}|}; second ]);
  check "an item that is not known"
    (two ^ "; note: item 2 of the mission: Marker is not an item that is known here, and left out")
    (read [ first; {|{"type":"Marker","params":[0,0,0,0,1,1,1]}|}; second ])

(* {1 Archives} *)

(* Files without compression, with their checksums or another. *)
let archive ?(check = fun text -> Int32.to_int (Zlib.update_crc_string 0l text 0 (String.length text))) files =
  let b = Buffer.create 1000 and directory = Buffer.create 1000 in
  let u16 b n = Buffer.add_uint16_le b n and u32 b n = Buffer.add_int32_le b (Int32.of_int n) in
  let common b text =
    List.iter (u16 b) [ 20; 0; 0; 0; 0 ];
    u32 b (check text);
    u32 b (String.length text);
    u32 b (String.length text)
  in
  let add (name, text) =
    let start = Buffer.length b in
    u32 b 0x04034b50;
    common b text;
    List.iter (u16 b) [ String.length name; 0 ];
    Buffer.add_string b (name ^ text);
    u32 directory 0x02014b50;
    u16 directory 20;
    common directory text;
    List.iter (u16 directory) [ String.length name; 0; 0; 0; 0 ];
    u32 directory 0;
    u32 directory start;
    Buffer.add_string directory name
  in
  List.iter add files;
  let start = Buffer.length b in
  Buffer.add_buffer b directory;
  u32 b 0x06054b50;
  List.iter (u16 b) [ 0; 0; List.length files; List.length files ];
  u32 b (Buffer.length directory);
  u32 b start;
  u16 b 0;
  Buffer.contents b

let place name = Printf.sprintf "<Placemark><name>%s</name><Point><coordinates>-8,41</coordinates></Point></Placemark>" name
let link href = Printf.sprintf "<NetworkLink><Link><href>%s</href></Link></NetworkLink>" href
let kml inside = "<kml>" ^ inside ^ "</kml>"

let archives () =
  let at = ": (41.000000, -8.000000)" in
  let read files = shown "m.kmz" (archive files) in
  check "one" ("a" ^ at) (read [ ("a.kml", kml (place "a")) ]);
  check "a resource fork" ("a" ^ at)
    (read [ ("__MACOSX/._doc.kml", "\000\005"); ("doc.kml", kml (place "a")); ("._a.kml", "\000") ]);
  check "doc.kml is the map" ("a" ^ at ^ "; note: b.kml: doc.kml does not link to this file, and left out")
    (read [ ("b.kml", kml (place "b")); ("doc.kml", kml (place "a")) ]);
  check "links are followed, each once"
    ("a" ^ at ^ "; b" ^ at ^ "; note: files/b.kml, line 1: the link to '../doc.kml' is not followed, and left out")
    (read
       [ ("doc.kml", kml (place "a" ^ link "files/b.kml")); ("files/b.kml", kml (place "b" ^ link "../doc.kml")) ]);
  check "another checksum" "wrong: 'doc.kml' in this archive is damaged: its checksum is another"
    (shown "m.kmz" (archive ~check:(fun _ -> 7) [ ("doc.kml", kml (place "a")) ]))

(* An archive by another program, cut or changed at any byte, ends at once: as an error or as the same map. *)
let damaged_archives =
  let whole =
    archive [ ("doc.kml", kml (place "a")) ] in
  let good = shown "m.kmz" whole in
  let gen = QCheck2.Gen.(pair (int_bound (String.length whole - 1)) (int_bound 255)) in
  Test_support.Property.case ~count:2000 "a byte of an archive is changed" gen
    ~print:(fun (i, c) -> Printf.sprintf "%d is %d" i c)
    (fun (i, c) ->
       let text = String.mapi (fun j old -> if i = j then Char.chr c else old) whole in
       let found = shown "m.kmz" text in
       found = good || String.starts_with ~prefix:"wrong: " found
       || (* its name is no part of what is checked *) String.starts_with ~prefix:"note: " found)

(* A stream of deflate that is cut anywhere. *)
let cut_streams () =
  let packed text =
    let b = Buffer.create 100 and read = ref 0 in
    let refill bytes =
      let n = Int.min (Bytes.length bytes) (String.length text - !read) in
      Bytes.blit_string text !read bytes 0 n;
      read := !read + n;
      n
    in
    Zlib.compress ~header:false refill (fun bytes n -> Buffer.add_subbytes b bytes 0 n);
    Buffer.contents b
  in
  let text = kml (String.concat "" (List.init 50 (fun i -> place (string_of_int i)))) in
  let stream = packed text in
  let archive stream =
    let name = "doc.kml" in
    let b = Buffer.create 1000 in
    let u16 n = Buffer.add_uint16_le b n and u32 n = Buffer.add_int32_le b (Int32.of_int n) in
    let common () =
      List.iter u16 [ 20; 0; 8; 0; 0 ];
      u32 (Int32.to_int (Zlib.update_crc_string 0l text 0 (String.length text)));
      u32 (String.length stream);
      u32 (String.length text)
    in
    u32 0x04034b50;
    common ();
    List.iter u16 [ String.length name; 0 ];
    Buffer.add_string b (name ^ stream);
    let start = Buffer.length b in
    u32 0x02014b50;
    u16 20;
    common ();
    List.iter u16 [ String.length name; 0; 0; 0; 0 ];
    u32 0;
    u32 0;
    Buffer.add_string b name;
    let length = Buffer.length b - start in
    u32 0x06054b50;
    List.iter u16 [ 0; 0; 1; 1 ];
    u32 length;
    u32 start;
    u16 0;
    Buffer.contents b
  in
  let read stream = Map_file.read ~path:"m.kmz" (archive stream) in
  Alcotest.(check bool) "whole" true (Result.is_ok (read stream));
  for length = 0 to String.length stream - 1 do
    if Result.is_ok (read (String.sub stream 0 length)) then Alcotest.failf "cut to %d bytes, it is read" length
  done

(* {1 Damaged files} *)

let samples =
  [ ("m.geojson", collection [ feature "Polygon" (Printf.sprintf "[%s,[]]" square); feature "LineString" "[[1,2],[3,4,5]]" ]);
    ("m.kml", kml ("<Placemark><name>a</name><MultiGeometry><Polygon><outerBoundaryIs><LinearRing><coordinates>0,0 1e-3,0 \
                    .001,0.001 0,0</coordinates></LinearRing></outerBoundaryIs></Polygon></MultiGeometry></Placemark>"
                   ^ link "a.kml"));
    ("m.kmz", archive [ ("doc.kml", kml (place "a")); ("b.kml", kml (place "b")) ]);
    ("m.gpx", "<?xml version='1.0' encoding='windows-1252'?><gpx><wpt lat='1' lon='2'><ele>3</ele></wpt><trk><trkseg>\
               <trkpt lat='1' lon='2'/></trkseg></trk></gpx>");
    ("m.plan", {|{"fileType":"Plan","mission":{"plannedHomePosition":[41,-8,10],"items":[{"type":"SimpleItem","frame":3,
      "command":16,"params":[0,0,0,null,41.1,-8,30]},{"type":"ComplexItem","complexItemType":"survey","polygon":[[0,0],
      [0,0.001],[0.001,0]]}]},"geoFence":{"circles":[{"circle":{"center":[41,-8],"radius":9}}]},"rallyPoints":
      {"points":[[1,2,3]]}}|});
    ("m.nmap", "<map><features><path><id>x</id><coordinate><latitude>41N30'36.0''</latitude><longitude>8W15'0''</longitude>\
                </coordinate><shape>true</shape><translation><n>1</n><e>2</e></translation></path><QRouteElement><path>1,2;\
                3,4</path></QRouteElement></features></map>") ]

type damage = Cut | Changed of char | Inserted of string

(* Digits, brackets and quotes are changed into others more often than chance would. *)
let damage =
  let open QCheck2.Gen in
  let character = oneof [ char; oneofl [ '0'; '9'; '-'; '.'; 'e'; '"'; '['; ']'; '{'; '}'; '<'; '>'; '/'; ','; ' '; '\''; '&' ] ] in
  let inserted = oneofl [ "1e999"; "nan"; "0x29"; "[]"; "null"; "-1e308"; "\xff"; "99999999999999999999"; "<a>"; "]]>" ] in
  oneof [ return Cut; map (fun c -> Changed c) character; map (fun c -> Changed c) character;
          map (fun text -> Inserted text) inserted ]

let damaged text (share, damage) =
  let n = String.length text in
  let i = Int.min (n - 1) (int_of_float (share *. float_of_int n)) in
  let before = String.sub text 0 i and behind = String.sub text (i + 1) (n - i - 1) in
  match damage with
  | Cut -> before
  | Changed c -> before ^ String.make 1 c ^ behind
  | Inserted more -> before ^ more ^ behind

let is_fit text =
  let rec go i =
    i >= String.length text
    || (text.[i] >= ' ' && text.[i] <> '\127'
        && go (i + 1)) in
  go 0

let damaged_files =
  let open QCheck2.Gen in
  let gen = pair (oneofl samples) (list_size (int_range 1 6) (pair (float_bound_inclusive 1.) damage)) in
  let text ((_, text), damages) =
    List.fold_left (fun text d -> if text = "" then text else damaged text d) text damages in
  Test_support.Property.case ~count:5000 "damaged files" gen ~print:(fun x -> fst (fst x) ^ ": " ^ String.escaped (text x))
    (fun x ->
       let path = fst (fst x) in
       (match Map_file.outlines ~path (text x) with
        | Ok outlines -> List.for_all (fun (name, _) -> is_fit name) outlines
        | Error why -> is_fit why)
       &&
       match Map_file.read ~path (text x) with
       | Ok { things; notes } ->
         let names = List.map fst things in
         List.length (List.sort_uniq String.compare names) = List.length names
         && List.for_all is_fit names && List.for_all is_fit notes
         && List.for_all (fun (_, thing) -> match thing with Ok _ -> true | Error why -> is_fit why) things
       | Error why -> is_fit why)

let reading_neptus () =
  let at = "<coordinate><latitude>41N30'36.0''</latitude><longitude>8W15'0''</longitude><height>0</height>" in
  let element kind inside = Printf.sprintf "<%s><id>x</id><name>id_1</name>%s</coordinate>%s</%s>" kind at inside kind in
  let read inside = shown "m.nmap" (Printf.sprintf "<map><header/><features>%s</features></map>" inside) in
  let step n e = Printf.sprintf "<translation><n>%d</n><e>%d</e><d>0</d></translation>" n e in
  check "a mark" "x: (41.510000, -8.250000)" (read (element "mark" ""));
  check "degrees with signs, an offset" "x: (40.999999, -7.988114, -2.0 m)"
    (read
       "<mark><id>x</id><coordinate><latitude>41.0</latitude><longitude>-8.0</longitude><depth>2</depth>\
        <offset-east>1000</offset-east></coordinate></mark>");
  check "a path" "x: line of 2" (read (element "path" (step 0 0 ^ step 10 0)));
  check "a shape" "x: 50 m2, 3 corners" (read (element "path" ("<shape>true</shape>" ^ step 0 0 ^ step 10 0 ^ step 0 10)));
  check "a shape that crosses itself" "x: line of 4"
    (read (element "path" ("<shape>true</shape>" ^ step 0 0 ^ step 10 10 ^ step 10 0 ^ step 0 10)));
  let box psi =
    Printf.sprintf "<attitude><psi>%s</psi></attitude><type>Parallelepiped</type><dimensions><x-dim>20</x-dim>\
                    <y-dim>40</y-dim></dimensions>" psi in
  check "a box" "x: 800 m2, 4 corners" (read (element "geometry" (box "-37")));
  check "a mine danger area" "x: 314 m2, 128 corners" (read (element "MineDangerAreaElement" "<radius>10</radius>"));
  check "a picture" "" (read (element "image" "<href>../../a.png</href>"));
  check "no coordinate" "wrong: line 1: mark has no coordinate" (read "<mark><id>x</id></mark>")

(* Which way a box lies: its length is along its heading. *)
let a_box_is_turned () =
  let text =
    "<map><features><geometry><id>x</id><coordinate><latitude>41</latitude><longitude>-8</longitude></coordinate>\
     <attitude><psi>90</psi></attitude><type>Parallelepiped</type><dimensions><x-dim>20</x-dim><y-dim>400</y-dim>\
     </dimensions></geometry></features></map>" in
  match Map_file.read ~path:"m.nmap" text with
  | Ok { things = [ (_, Ok (Area area)) ]; _ } ->
    let inside north east = Area.contains area (Wgs84.displace (at 41. (-8.)) ~north ~east) in
    Alcotest.(check (list bool)) "east, north" [ true; false ] [ inside 0. 190.; inside 15. 0. ]
  | Ok _ | Error _ -> Alcotest.fail "one area is there"

(* {1 As it is drawn} *)

let outlines () =
  let point (p : Position.t) = Printf.sprintf "%g %g" p.latitude p.longitude in
  let points ps = String.concat ", " (List.map point ps) in
  let one (name, (outline : Map_file.outline)) =
    name ^ ": "
    ^ match outline with
    | Spot p -> point p
    | Way ps -> points ps
    | Rings rings -> String.concat " / " (List.map points rings)
    | Round { centre; radius } -> Printf.sprintf "%g m around %s" radius (point centre)
  in
  let drawn path text =
    match Map_file.outlines ~path text with
    | Ok found -> String.concat "; " (List.map one found)
    | Error why -> "wrong: " ^ why
  in
  let geojson geometry = Printf.sprintf {|{"type":"Feature","properties":{"name":"a"},"geometry":%s}|} geometry in
  check "rings that make no area" "a: 1 0, 0 1, 0 0, 1 1 / 5 5"
    (drawn "m.geojson"
       (geojson {|{"type":"MultiPolygon","coordinates":[[[[0,1],[1,0],[0,0],[1,1]]],[[[5,5]]]]}|}));
  check "without a name, in upper case" ": 41 -8; : 41 -8, 42 -8"
    (drawn "M.GPX"
       "<gpx><wpt lat='41' lon='-8'/><rte><rtept lat='41' lon='-8'/><rtept lat='42' lon='-8'/></rte></gpx>");
  check "a circle" "inside 1: 5 m around 41 -8"
    (drawn "m.plan"
       {|{"fileType":"Plan","mission":{"items":[]},"geoFence":{"circles":[{"circle":{"center":[41,-8],"radius":5}}]}}|});
  check "what is wrong" "wrong: line 1: latitude 91 is not from -90 to 90 degrees"
    (drawn "m.gpx" "<gpx><wpt lat='91' lon='0'/></gpx>")

(* {1 Tiles} *)

let table = "CREATE TABLE tiles (zoom_level integer, tile_column integer, tile_row integer, tile_data blob);"
let index = "CREATE UNIQUE INDEX tile_index ON tiles (zoom_level, tile_column, tile_row);"
let metadata pairs =
  "CREATE TABLE metadata (name text, value text);"
  ^ String.concat "" (List.map (fun (k, x) -> Printf.sprintf "INSERT INTO metadata VALUES ('%s', '%s');" k x) pairs)

let with_tiles sql f =
  let path = Filename.temp_file "tiles" ".mbtiles" in
  Fun.protect ~finally:(fun () -> Sys.remove path) (fun () ->
      let db = Sqlite3.db_open path in
      List.iter (fun sql -> Sqlite3.Rc.check (Sqlite3.exec db sql)) sql;
      ignore (Sqlite3.db_close db);
      f path)

let described path =
  match Tile_file.read path with
  | Error why -> "wrong: " ^ why
  | Ok { minimum; maximum; bounds; attribution } ->
    let bounds =
      Option.fold bounds ~none:"everywhere" ~some:(fun (w, s, e, n) -> Printf.sprintf "%g %g %g %g" w s e n) in
    Printf.sprintf "%d to %d, %s, '%s'" minimum maximum bounds attribution

let tile path zoom column row =
  match Tile_file.tile path ~zoom ~column ~row with
  | Ok (Some { kind; bytes }) -> Printf.sprintf "%s %d" kind (String.length bytes)
  | Ok None -> "none"
  | Error why -> "wrong: " ^ why

let add zoom column row data = Printf.sprintf "INSERT INTO tiles VALUES (%d, %d, %d, %s);" zoom column row data
let png = "x'89504e470d0a1a0a'"

let tiles () =
  let known = [ ("minzoom", "3"); ("maxzoom", "15"); ("bounds", "-9,41,-8.5, 42"); ("attribution", "us"); ("format", "png") ] in
  let all =
    [ table; index; metadata known; add 3 1 0 png; add 3 1 1 "x'ffd8ffe0'"; add 3 2 1 "x'524946460000000057454250'";
      add 3 3 1 "x'1f8b'"; add 3 4 1 "zeroblob(2000001)"; add 3 5 1 "'text'" ] in
  with_tiles all (fun path ->
      check "what they are" "3 to 15, -9 41 -8.5 42, 'us'" (described path);
      check "rows are counted from the north" "image/png 8" (tile path 3 1 7);
      check "jpg" "image/jpeg 4" (tile path 3 1 6);
      check "webp" "image/webp 12" (tile path 3 2 6);
      check "no picture" "wrong: this tile is no picture: neither png nor jpg nor webp" (tile path 3 3 6);
      check "too long" "none" (tile path 3 4 6);
      check "a text" "none" (tile path 3 5 6);
      check "not there" "none" (tile path 3 1 0);
      check "too deep" "none" (tile path 63 0 0))

let strange_tiles () =
  let read sql = with_tiles sql described in
  check "nothing known" "0 to 24, everywhere, ''" (read [ table; index ]);
  let some = [ table; index; add 3 1 1 png; add 5 0 0 png ] in
  check "levels of the tiles" "3 to 5, everywhere, ''" (read some);
  check "the last level of the tiles" "2 to 5, everywhere, ''" (read (some @ [ metadata [ ("minzoom", "2") ] ]));
  check "a level in hexadecimal" "3 to 5, everywhere, ''" (read (some @ [ metadata [ ("maxzoom", "0x7") ] ]));
  check "numbers, and bounds that are none" "2 to 24, everywhere, ''"
    (read [ table; index; "CREATE TABLE metadata (name, value)"; "INSERT INTO metadata VALUES ('minzoom', 2)";
            "INSERT INTO metadata VALUES ('maxzoom', 'x')"; "INSERT INTO metadata VALUES ('bounds', '1,2,3')" ]);
  check "vectors" "wrong: its tiles are vectors (pbf), and only pictures are shown: png, jpg, webp"
    (read [ table; index; metadata [ ("format", "pbf") ] ]);
  check "levels" "wrong: it has no tiles from level 9 to level 3"
    (read [ table; index; metadata [ ("minzoom", "9"); ("maxzoom", "3") ] ]);
  let slow = "wrong: its tiles have no index by zoom_level, tile_column and tile_row" in
  check "no index" slow (read [ table; metadata [] ]);
  let endless =
    "CREATE VIEW tiles AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT 1 AS zoom_level, i AS \
     tile_column, i AS tile_row, 'x' AS tile_data FROM n" in
  with_tiles [ endless ] (fun path ->
      check "a view without end" slow (described path);
      check "is not asked" "none" (tile path 1 0 0));
  let shared =
    [ "CREATE TABLE map (zoom_level integer, tile_column integer, tile_row integer, tile_id text)";
      "CREATE TABLE images (tile_id text, tile_data blob)";
      "CREATE UNIQUE INDEX map_index ON map (zoom_level, tile_column, tile_row)";
      "CREATE UNIQUE INDEX images_id ON images (tile_id)";
      "CREATE VIEW tiles AS SELECT zoom_level, tile_column, tile_row, tile_data FROM map JOIN images ON images.tile_id = \
       map.tile_id"; "INSERT INTO map VALUES (1, 0, 0, 'a')"; "INSERT INTO images VALUES ('a', " ^ png ^ ")" ] in
  with_tiles shared (fun path ->
      check "a view of tiles that share pictures" "1 to 1, everywhere, ''" (described path);
      check "one of them" "image/png 8" (tile path 1 0 1));
  let path = Filename.temp_file "tiles" ".mbtiles" in
  Fun.protect ~finally:(fun () -> Sys.remove path) (fun () ->
      let refused what path =
        Alcotest.(check bool) what true (Result.is_error (Tile_file.read path));
        Alcotest.(check bool) (what ^ ": no tile") true (Result.is_error (Tile_file.tile path ~zoom:1 ~column:0 ~row:0))
      in
      refused "an empty database" path;
      let channel = open_out path in
      output_string channel (String.make 5000 'x');
      close_out channel;
      refused "no database" path;
      refused "no file" "/nowhere/at/all.mbtiles")

let () =
  Alcotest.run "maps"
    [ ( "writing",
        [ case "times" times; case "the meridian of 180 degrees" cutting; case "GeoJSON" geojson; case "XML" xml;
          case "CSV" csv; case "long tracks" long_tracks ] );
      ( "reading",
        [ case "GeoJSON" reading_geojson; case "wrong GeoJSON" wrong_geojson; case "KML" reading_kml;
          case "GPX" reading_gpx; case "plans of QGroundControl" reading_plans; case "maps of Neptus" reading_neptus;
          case "a box is turned" a_box_is_turned; case "outlines" outlines;
          case "empty geometries" empty_geometries; case "bad features" bad_features;
          case "slightly wrong polygons" repaired; case "coordinate systems" coordinate_systems;
          case "encodings" encodings; case "missions" missions; case "archives" archives;
          case "streams cut short" cut_streams; damaged_archives; damaged_files ] );
      ("tiles", [ case "pictures" tiles; case "strange databases" strange_tiles ]) ]
