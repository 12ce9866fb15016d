open Dolphin_maps
open Shown

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
      check "no picture" "wrong: this tile is not a picture: neither png nor jpg nor webp" (tile path 3 3 6);
      check "too long" "none" (tile path 3 4 6);
      check "a text" "none" (tile path 3 5 6);
      check "not there" "none" (tile path 3 1 0);
      check "too deep" "none" (tile path 63 0 0))

let strange_tiles () =
  let read sql = with_tiles sql described in
  check "nothing known" "wrong: it has no tiles" (read [ table; index ]);
  check "an index that does not find levels"
    "wrong: its metadata lack minzoom or maxzoom, and its index does not begin with zoom_level"
    (read [ table; "CREATE INDEX i ON tiles (tile_column, tile_row, zoom_level);"; add 3 1 1 png ]);
  check "one with known levels" "3 to 4, everywhere, ''"
    (read [ table; "CREATE INDEX i ON tiles (tile_column, tile_row, zoom_level);"; add 3 1 1 png;
            metadata [ ("minzoom", "3"); ("maxzoom", "4") ] ]);
  let some = [ table; index; add 3 1 1 png; add 5 0 0 png ] in
  check "levels of the tiles" "3 to 5, everywhere, ''" (read some);
  check "the last level of the tiles" "2 to 5, everywhere, ''" (read (some @ [ metadata [ ("minzoom", "2") ] ]));
  check "a level in hexadecimal" "3 to 5, everywhere, ''" (read (some @ [ metadata [ ("maxzoom", "0x7") ] ]));
  check "numbers, and bounds that are none" "2 to 5, everywhere, ''"
    (read [ table; index; add 5 0 0 png; "CREATE TABLE metadata (name, value)"; "INSERT INTO metadata VALUES ('minzoom', 2)";
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

let cases =
  [ case "pictures" tiles;
    case "strange databases" strange_tiles ]
