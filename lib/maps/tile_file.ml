module Numeral = Dolphin_numerals.Numeral

type t = {
  minimum : int;
  maximum : int;
  bounds : (float * float * float * float) option;
  attribution : string;
}

type image = { kind : string; bytes : string }

let deepest = 24
let most_bytes = 2_000_000
let most_text = 1_000

let ( let* ) = Result.bind
let ( let+ ) result f = Result.map f result

(* {1 Asking the database} *)

(* Which of its exceptions SQLite's library raises where depends on its version. *)
let ask db query parameters : (Sqlite3.Data.t array list, string) result =
  let rows () =
    let statement = Sqlite3.prepare db query in
    let finally () = ignore (Sqlite3.finalize statement) in
    Fun.protect ~finally (fun () ->
        ignore (Sqlite3.bind_values statement parameters);
        Sqlite3.fold statement ~f:(fun rows row -> row :: rows) ~init:[])
  in
  match rows () with
  | (OK | DONE), rows -> Ok (List.rev rows)
  | _, _ | exception (Sqlite3.Error _ | Sqlite3.SqliteError _ | Sqlite3.InternalError _) -> Error (Sqlite3.errmsg db)

let with_database path f =
  match Sqlite3.db_open ~mode:`READONLY path with
  | exception (Sqlite3.Error _ | Sqlite3.SqliteError _ | Sqlite3.InternalError _) -> Error "it cannot be opened"
  | db ->
    Sqlite3.busy_timeout db 1000;
    let finally () = ignore (Sqlite3.db_close db) in
    Fun.protect ~finally (fun () -> f db)

(* {1 What the tiles are} *)

let one_tile = "SELECT tile_data FROM tiles WHERE zoom_level = ? AND tile_column = ? AND tile_row = ?"
let place zoom column row = List.map (fun n -> Sqlite3.Data.INT (Int64.of_int n)) [ zoom; column; row ]

let is_search step =
  String.starts_with ~prefix:"SEARCH" step && not (List.mem "AUTOMATIC" (String.split_on_char ' ' step))

(* Without an index each tile takes a look at all of them; a view may even search without end. *)
let searches db query parameters =
  let+ plan = ask db ("EXPLAIN QUERY PLAN " ^ query) parameters in
  let step row = match row.(Array.length row - 1) with Sqlite3.Data.TEXT text -> text | _ -> "" in
  List.for_all (fun row -> is_search (step row)) plan

let is_quick db = searches db one_tile (place 0 0 0)

let metadata db name =
  let query = "SELECT substr(value, 1, ?) FROM metadata WHERE name = ? LIMIT 1" in
  match ask db query [ INT (Int64.of_int most_text); TEXT name ] with
  | Ok [ [| TEXT text |] ] -> Some text
  | Ok [ [| INT n |] ] -> Some (Int64.to_string n)
  | Ok _ | Error _ -> None

let level db name =
  match Option.bind (metadata db name) (fun text -> Numeral.whole (String.trim text)) with
  | Some n when 0 <= n && n <= deepest -> Some n
  | Some _ | None -> None

(* The first and the last level that have tiles. *)
let levels_with_tiles db =
  let query = "SELECT 1 FROM tiles WHERE zoom_level = ? LIMIT 1" in
  let at level = [ Sqlite3.Data.INT (Int64.of_int level) ] in
  let has_tiles level = match ask db query (at level) with Ok (_ :: _) -> true | Ok [] | Error _ -> false in
  let* quick = searches db query (at 0) in
  if not quick then Error "its metadata lack minzoom or maxzoom, and its index does not begin with zoom_level"
  else
    match List.filter has_tiles (List.init (deepest + 1) Fun.id) with
    | [] -> Error "it has no tiles"
    | first :: others -> Ok (first, List.fold_left (fun _ level -> level) first others)

let bounds db =
  let numbers text = List.map (fun part -> Numeral.number (String.trim part)) (String.split_on_char ',' text) in
  match Option.map numbers (metadata db "bounds") with
  | Some [ Some west; Some south; Some east; Some north ]
    when -180. <= west && west < east && east <= 180. && -90. <= south && south < north && north <= 90. ->
    Some (west, south, east, north)
  | Some _ | None -> None

let read path =
  with_database path (fun db ->
      let* quick =
        Result.map_error (fun why -> "it is not an MBTiles file: no table of tiles: " ^ why) (is_quick db) in
      match metadata db "format" with
      | _ when not quick -> Error "its tiles have no index by zoom_level, tile_column and tile_row"
      | Some "pbf" -> Error "its tiles are vectors (pbf), and only pictures are shown: png, jpg, webp"
      | Some _ | None ->
        let known = (level db "minzoom", level db "maxzoom") in
        let* first, last =
          match known with
          | Some first, Some last -> Ok (first, last)
          | (Some _ | None), (Some _ | None) -> levels_with_tiles db
        in
        let minimum = Option.value (fst known) ~default:first and maximum = Option.value (snd known) ~default:last in
        if minimum > maximum then Error (Printf.sprintf "it has no tiles from level %d to level %d" minimum maximum)
        else
          let attribution = Utf8_text.harmless (Option.value (metadata db "attribution") ~default:"") in
          Ok { minimum; maximum; bounds = bounds db; attribution })

(* {1 A tile} *)

let kinds = [ ("\x89PNG\r\n", "image/png"); ("\xff\xd8\xff", "image/jpeg"); ("RIFF", "image/webp") ]

let image bytes =
  match List.find_opt (fun (first, _) -> String.starts_with ~prefix:first bytes) kinds with
  | Some (_, kind) -> Ok (Some { kind; bytes })
  | None -> Error "this tile is not a picture: neither png nor jpg nor webp"

(* Rows are counted from the south in the file. *)
let tile path ~zoom ~column ~row =
  if not (0 <= zoom && zoom <= deepest) then Ok None
  else
    with_database path (fun db ->
        let* quick = is_quick db in
        let query = Printf.sprintf "%s AND length(tile_data) <= %d LIMIT 1" one_tile most_bytes in
        let* found = if quick then ask db query (place zoom column ((1 lsl zoom) - 1 - row)) else Ok [] in
        match found with
        | [| BLOB bytes |] :: _ -> image bytes
        | _ -> Ok None)
