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
  | Ok things ->
    let one (name, (thing : Map_file.thing)) =
      match thing with
      | Point p -> Format.asprintf "%s: %a" name Position.pp p
      | Line ps -> Printf.sprintf "%s: line of %d" name (List.length ps)
      | Area area -> Printf.sprintf "%s: %.0f m2, %d corners" name (Area.size area) (List.length (Area.corners area))
    in
    String.concat "; " (List.map one things)

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
  check "no geometry" "" (read [ {|{"type":"Feature","properties":{},"geometry":null}|} ]);
  check "a bare geometry" "point 1: (2.000000, 1.000000)" (shown "m.json" {|{"type":"Point","coordinates":[1,2]}|})

let wrong_geojson () =
  let read text = shown "M.GeoJSON" text in
  let told features = read (collection features) in
  (* In the words of the library, which differ from one release to the next. *)
  let begins_with start text = check start start (String.sub text 0 (min (String.length start) (String.length text))) in
  begins_with "wrong: line 2, bytes " (read "[1\n }");
  begins_with "wrong: line 1, bytes " (read "[1, 2");
  check "something else" "wrong: this is no GeoJSON: it has no \"type\": \"FeatureCollection\"" (read "[1]");
  check "a geometry that is none" "wrong: feature 2 ('a'): GeoJSON has no geometry 'Circle'"
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
  check "what has no place" "" (read (placed "n" "" ^ "<Style/>"));
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
  | Ok [ (_, Area area) ] ->
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
      check "a view of tiles that share pictures" "0 to 24, everywhere, ''" (described path);
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
          case "a box is turned" a_box_is_turned; case "outlines" outlines ] );
      ("tiles", [ case "pictures" tiles; case "strange databases" strange_tiles ]) ]
