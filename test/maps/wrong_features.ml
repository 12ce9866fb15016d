open Shown

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
  check "KML: a polygon without rings" note (kml "<Polygon><outerBoundaryIs/><innerBoundaryIs/></Polygon>");
  check "KML: no polygon in several" note (kml "<MultiGeometry><Point/><Polygon/></MultiGeometry>");
  check "KML: an empty part" "a: (0.000000, 2.000000)"
    (kml "<MultiGeometry><Point/><Point><coordinates>2,0</coordinates></Point></MultiGeometry>");
  List.iter
    (fun tag -> check ("KML: " ^ tag) note (kml (Printf.sprintf "<%s/>" tag)))
    [ "Point"; "LineString"; "LinearRing"; "Polygon"; "Track"; "MultiGeometry"; "MultiTrack" ];
  check "KML: no geometry" "note: line 1 ('a'): it has no geometry, and is left out" (kml "");
  let geojson geometry = shown "m.geojson" (Printf.sprintf {|{"type":"Feature","geometry":%s}|} geometry) in
  List.iter
    (fun kind ->
       let note = "note: feature 1: it is empty, and left out" in
       check (kind ^ " without coordinates") note (geojson (Printf.sprintf {|{"type":"%s"}|} kind));
       check (kind ^ ": null") note
         (geojson (Printf.sprintf {|{"type":"%s","coordinates":null,"geometries":null}|} kind)))
    [ "Point"; "MultiPoint"; "LineString"; "MultiLineString"; "Polygon"; "MultiPolygon"; "GeometryCollection" ];
  let gpx inside = shown "m.gpx" ("<gpx>" ^ inside ^ "</gpx>") in
  List.iter
    (fun inside -> check ("GPX: " ^ inside) note (gpx inside))
    [ "<rte><name>a</name></rte>"; "<trk><name>a</name></trk>"; "<trk><name>a</name><trkseg/></trk>";
      "<wpt><name>a</name></wpt>"; "<wpt lat='' lon=''><name>a</name></wpt>" ]

(* Rings of both formats repeat their first position at the end; one that does not may lack corners. *)
let json_ring ring =
  let position text = "[" ^ text ^ "]" in
  "[" ^ String.concat "," (List.map position (String.split_on_char ' ' ring)) ^ "]"

let json_polygon rings = "[" ^ String.concat "," (List.map json_ring rings) ^ "]"
let kml_ring ring = Printf.sprintf "<LinearRing><coordinates>%s</coordinates></LinearRing>" ring

let kml_polygon rings =
  let side name ring = Printf.sprintf "<%s>%s</%s>" name (kml_ring ring) name in
  let holes = List.map (side "innerBoundaryIs") (List.tl rings) in
  Printf.sprintf "<Polygon>%s%s</Polygon>" (side "outerBoundaryIs" (List.hd rings)) (String.concat "" holes)

let kml_place inside = shown "m.kml" ("<kml><Placemark><name>a</name>" ^ inside ^ "</Placemark></kml>")

let in_both what area notes polygons =
  let found =
    [ ("feature 1 ('a')",
       let polygons = String.concat "," (List.map json_polygon polygons) in
       shown "m.geojson" (collection [ feature "MultiPolygon" ("[" ^ polygons ^ "]") ]));
      ("line 1 ('a')",
       kml_place ("<MultiGeometry>" ^ String.concat "" (List.map kml_polygon polygons) ^ "</MultiGeometry>")) ] in
  let compare (place, found) =
    let note why = Printf.sprintf "note: %s: %s, and is closed by a straight line" place why in
    check what (String.concat "; " (area :: List.map note notes)) found in
  List.iter compare found

let open_rings () =
  let rim = "0,0 0.001,0 0.001,0.001 0,0.001" and hole = "0.0002,0.0002 0.0002,0.0007 0.0007,0.0007" in
  let second = "0.002,0 0.003,0 0.003,0.001 0.002,0.001" and second_closed = " 0.002,0" in
  let area = "a: 12309 m2, 4 corners" in
  in_both "closed" area [] [ [ rim ^ " 0,0" ] ];
  in_both "by less than a millimetre" area [] [ [ rim ^ " 0.000000005,0.000000005" ] ];
  in_both "by two millimetres" "a: 12309 m2, 5 corners" [ "the rim ends 0.002 m from its beginning" ]
    [ [ rim ^ " 0,0.00000002" ] ];
  in_both "by a side" area [ "the rim ends 111 m from its beginning" ] [ [ rim ] ];
  in_both "by a kilometre" "a: 67331 m2, 4 corners" [ "the rim ends 1110 m from its beginning" ]
    [ [ "0,0 0.001,0 0.001,0.001 0.0001,0.01004" ] ];
  in_both "a hole" "a: 10770 m2, 7 corners" [ "hole 1 ends 78 m from its beginning" ] [ [ rim ^ " 0,0"; hole ] ];
  in_both "of several" "a: 23080 m2, 11 corners"
    [ "hole 1 of polygon 1 ends 78 m from its beginning"; "the rim of polygon 2 ends 111 m from its beginning" ]
    [ [ rim ^ " 0,0"; hole ]; [ second ] ];
  in_both "several that are closed" "a: 24618 m2, 8 corners" [] [ [ rim ^ " 0,0" ]; [ second ^ second_closed ] ];
  check "a ring without a polygon" "a: line of 5; note: line 1 ('a'): the ring ends 111 m from its beginning, and is \
                                    closed by a straight line" (kml_place (kml_ring rim));
  check "a closed one" "a: line of 5" (kml_place (kml_ring (rim ^ " 0,0")))

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
  check "GPX" "feature 1: flawed: line 1: '0x29' is not a number; point 1: (1.000000, 2.000000)"
    (shown "m.gpx" "<gpx><wpt lat='0x29' lon='-8_7'/><wpt lat='1' lon='2'/></gpx>");
  check "KML" "a: flawed: line 1: '4_1' is not a number; b: (1.000000, 2.000000)"
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
  let hole x =
    let east = x +. 0.0002 in
    Printf.sprintf "[[%g,0.0002],[%g,0.0002],[%g,0.0007],[%g,0.0007],[%g,0.0002]]" x east east x x in
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
  check "many corners" "a: 3867009 m2, 12000 corners"
    (read (Printf.sprintf "[%s,%s]" (String.concat "," many) (List.hd many)))

let coordinate_systems () =
  let with_crs crs = Printf.sprintf {|{"type":"FeatureCollection","crs":%s,"features":[%s]}|} crs (feature "Point" "[2,1]") in
  let named name = with_crs (Printf.sprintf {|{"type":"name","properties":{"name":"%s"}}|} name) in
  let read text = shown "m.geojson" text in
  List.iter
    (fun name -> check name "a: (1.000000, 2.000000)" (read (named name)))
    [ "urn:ogc:def:crs:OGC:1.3:CRS84"; "urn:ogc:def:crs:OGC::CRS84"; "EPSG:4326"; "urn:ogc:def:crs:EPSG::4326"; "epsg:4326";
      "http://www.opengis.net/def/crs/OGC/1.3/CRS84"; "http://www.opengis.net/def/crs/EPSG/0/4326"; "WGS84";
      "http://spatialreference.org/ref/epsg/4326/" ];
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
  check "a code as text" "a: (1.000000, 2.000000)" (read (with_crs {|{"type":"EPSG","properties":{"code":"4326"}}|}));
  check "a name by itself" "a: (1.000000, 2.000000)" (read (with_crs {|"EPSG:4326"|}));
  let refused = Printf.sprintf "wrong: its coordinates are in the system %s: they have to be in WGS 84, longitude first (EPSG:4326)" in
  check "another name by itself" (refused "EPSG:3857") (read (with_crs {|"EPSG:3857"|}));
  check "a link" (refused "at 'a', which is not looked up")
    (read (with_crs {|{"type":"link","properties":{"href":"a"}}|}));
  check "nothing" (refused "of a crs that names none") (read (with_crs "{}"))

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
  check "ISO 8859-15" ("\xe2\x82\xac Leix\xc3\xb5es" ^ place) (gpx "<?xml version='1.0' encoding='ISO-8859-15'?>" "\xa4 Leix\xf5es");
  check "a byte order mark before XML" ("a" ^ place) (gpx "\xef\xbb\xbf<?xml version='1.0'?>" "a");
  check "not UTF-8" "wrong" (String.sub (gpx "" "\xf5") 0 5)

(* What a reader would take the first of, or leave out. *)
let several () =
  let at = Printf.sprintf "<%s><coordinates>%s</coordinates></%s>" in
  let good = Printf.sprintf "<Placemark><name>b</name>%s</Placemark>" (at "Point" "1,0" "Point") in
  let kml inside = shown "m.kml" (Printf.sprintf "<kml><Placemark><name>a</name>%s</Placemark>%s</kml>" inside good) in
  let wrong why = "a: flawed: line 1: " ^ why ^ "; b: (0.000000, 1.000000)" in
  let ring = at "LinearRing" "1,2 1,2.1 1.1,2" "LinearRing" in
  check "a decimal comma" (wrong "coordinates are LONGITUDE,LATITUDE or LONGITUDE,LATITUDE,HEIGHT")
    (kml (at "Point" "-8,7,41,2" "Point"));
  check "two positions of a point" (wrong "a point has one position, not 2") (kml (at "Point" "1,2 3,4" "Point"));
  check "coordinates twice" (wrong "LineString has coordinates twice")
    (kml "<LineString><coordinates>1,2 3,4</coordinates><coordinates>5,6 7,8</coordinates></LineString>");
  check "two outer rings" (wrong "a polygon has one outer ring: several are a MultiGeometry of polygons")
    (kml (Printf.sprintf "<Polygon><outerBoundaryIs>%s%s</outerBoundaryIs></Polygon>" ring ring));
  check "an overlay" "b: (0.000000, 1.000000); note: line 1 ('a'): GroundOverlay is a picture, and left out"
    (shown "m.kml" (Printf.sprintf "<kml><GroundOverlay><name>a</name></GroundOverlay>%s</kml>" good))

(* An item that would leave a piece out of the way. *)
let items_of_plans () =
  let plan ?(fence = "") item =
    shown "m.plan"
      (Printf.sprintf
         {|{"fileType":"Plan","mission":{"plannedHomePosition":[1,2,0],"items":[{"command":16,"frame":3,"params":[0,0,0,0,1,2,0]},%s]}%s}|} item fence)
  in
  let way = {|{"command":16,"frame":3,"params":[0,0,0,0,1,3,0]}|} in
  let home = "home: (1.000000, 2.000000); " in
  let wrong why = home ^ "mission: flawed: item 2 of the mission: " ^ why in
  check "six parameters" (wrong "an item has seven parameters, not 6")
    (plan {|{"command":16,"frame":3,"params":[0,0,0,0,1,3]}|});
  check "half of a place" (wrong "a number belongs here") (plan {|{"command":16,"frame":3,"params":[0,0,0,0,1,null,0]}|});
  check "no parameters" (wrong "a list [...] belongs here") (plan {|{"command":16,"frame":3,"coordinate":[1,3,0]}|});
  check "a text as frame" (wrong "an item has a frame, a whole number")
    (plan {|{"command":16,"frame":"3","params":[0,0,0,0,1,3,0]}|});
  check "a text as command" (wrong "an item has a command, a whole number")
    (plan {|{"command":"16","frame":3,"params":[0,0,0,0,1,3,0]}|});
  check "no object" (wrong "an item has a command, a whole number") (plan "7");
  let fence = {|,"geoFence":{"circles":[{"circle":{"center":[1,2],"radius":9},"inclusion":"false"}]}|} in
  check "a fence on neither side" (home ^ "mission: line of 2; fence 1: flawed: circle 1 of the fence: inclusion is true or false")
    (plan ~fence way)

let cases =
  [ case "empty geometries" empty_geometries;
    case "rings that are open" open_rings;
    case "bad features" bad_features;
    case "slightly wrong polygons" repaired;
    case "coordinate systems" coordinate_systems;
    case "encodings" encodings;
    case "several of which one is meant" several;
    case "items of plans" items_of_plans ]
