open Dolphin_geo
open Dolphin_maps
open Shown

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
  check "something else" "wrong: this is not GeoJSON: it has no \"type\": \"FeatureCollection\"" (read "[1]");
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
  check "what has no place" "note: line 1 ('n'): it has no geometry, and is left out" (read (placed "n" "" ^ "<Style/>"));
  let polygon = "<Polygon><outerBoundaryIs>" ^ ring ^ "</outerBoundaryIs></Polygon>" in
  check "MultiPolygon" "a: 12309 m2, 4 corners" (read (placed "a" ("<MultiPolygon>" ^ polygon ^ "</MultiPolygon>")));
  check "a geometry that is not known" "note: line 1 ('a'): Circle is not known here, and left out"
    (read (placed "a" "<Circle><coordinates>0,0</coordinates></Circle>"));
  check "a link" "note: line 1 ('n'): the link to 'http://example.org/a.kml' is not followed, and left out"
    (read "<NetworkLink><name>n</name><Link><href>http://example.org/a.kml</href></Link></NetworkLink>");
  check "no number" "wrong: line 3: 'x' is not a number"
    (read (placed "p\n\n" "<Point><coordinates>-8,x\n\n</coordinates></Point>"));
  check "no coordinates" "note: line 1 ('p'): it is empty, and left out" (read (placed "p" "<Point/>"));
  check "another document" "wrong: line 1: this is not KML: its root is 'gpx'" (shown "m.kml" "<gpx/>");
  check "no XML" "wrong: line 2, column 2: this is not XML: expected root element" (shown "m.kml" "<!-- -->\n nothing")

let reading_gpx () =
  let read inside = shown "m.gpx" ("<gpx>" ^ inside ^ "</gpx>") in
  check "all" "w: (41.000000, -8.000000, 5.0 m); r: line of 2; t: line of 2; t 2: (1.000000, 3.000000)"
    (read
       "<metadata/><wpt lat='41' lon='-8'><ele>5</ele><name>w</name></wpt>\
        <rte><name>r</name><rtept lat='1' lon='1'/><rtept lat='1' lon='2'/></rte>\
        <trk><name>t</name><trkseg><trkpt lat='1' lon='1'/><trkpt lat='1' lon='2'/></trkseg>\
        <trkseg><trkpt lat='1' lon='3'/></trkseg><trkseg/></trk>");
  check "powers of ten" "t: line of 2; note: line 1 ('t'): '-2e-7' and 2 more are read, although GPX does not allow a \
                         power of ten"
    (read
       "<trk><name>t</name><trkseg><trkpt lat='49' lon='-2e-7'><ele>1e1</ele></trkpt><trkpt lat='1E0' lon='1'/>\
        </trkseg></trk>");
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
  check "another file" "wrong: this is not a plan of QGroundControl: it has no \"fileType\": \"Plan\"" (shown "m.plan" "{}")

(* Commands with a place that is not flown to, in frames that have no place on the globe, and landing patterns. *)
let missions () =
  let item ?(frame = 3) command place =
    Printf.sprintf {|{"type":"SimpleItem","command":%d,"frame":%d,"params":[0,0,0,null,%s]}|} command frame place in
  let plan items = Printf.sprintf {|{"fileType":"Plan","mission":{"items":[%s]}}|} (String.concat "," items) in
  let read items = shown "m.plan" (plan items) in
  let first = item 22 "41,-8,30" and second = item 16 "42,-8,30" in
  let two = "mission: line of 2" in
  check "two" two (read [ first; second ]);
  check "a take-off where it is" two (read [ item 22 "0,0,30"; first; second ]);
  check "a return" two (read [ first; second; item ~frame:2 20 "0,0,0" ]);
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

(* The letter E is that of the east, too. *)
let neptus_degrees () =
  let read latitude longitude =
    shown "m.nmap"
      (Printf.sprintf
         "<map><features><mark><id>m</id><coordinate><latitude>%s</latitude><longitude>%s</longitude></coordinate></mark>\
          </features></map>" latitude longitude) in
  check "a power of ten" "m: (0.000050, 0.000010)" (read "5.0E-5" "1.0E-5");
  check "east" "m: (41.500000, 8.500000)" (read "41N30'" "8E30'0''");
  check "decimal degrees" "m: (-38.825930, -8.500000)" (read "38.82593S" "8.5W");
  check "seconds that are rounded up" "m: (41.200000, 8.000000)" (read "41N11'60.0''" "8E");
  check "minutes below 0" "wrong: line 1: '-5' is not a number of minutes or seconds" (read "41N-5'" "8E");
  check "too many seconds" "wrong: line 1: '61' is not a number of minutes or seconds" (read "41N5'61''" "8E");
  check "a latitude in the east" "wrong: line 1: '41E30'' is not a number" (read "41E30'" "8E")

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

let cases =
  [ case "GeoJSON" reading_geojson;
    case "wrong GeoJSON" wrong_geojson;
    case "KML" reading_kml;
    case "GPX" reading_gpx;
    case "plans of QGroundControl" reading_plans;
    case "missions" missions;
    case "degrees of Neptus" neptus_degrees;
    case "maps of Neptus" reading_neptus;
    case "a box is turned" a_box_is_turned;
    case "outlines" outlines ]
