open Dolphin_json
open Exchange
module Map_file = Dolphin_maps.Map_file
module Tile_file = Dolphin_maps.Tile_file
module Request = Dolphin_http.Request
module Response = Dolphin_http.Response

let longest = 8 * 1024 * 1024

let is_tiles path = String.lowercase_ascii (Filename.extension path) = ".mbtiles"

let of_folder w r =
  let* path = parameter r "path" in
  let* full = Workspace.file w path in
  if Folder.kind full = Some Layer then Ok full else bad "this is not a layer"

let no_layer path why = refusal 422 "no-layer" (Printf.sprintf "%s: %s" (Filename.basename path) why)

(* {1 Shapes} *)

let shape (name, outline) : json =
  let members : (string * json) list =
    match (outline : Map_file.outline) with
    | Spot p -> [ ("position", On_map.pair p) ]
    | Way ps -> [ ("line", On_map.path ps) ]
    | Rings rings -> [ ("rings", `List (List.map On_map.path rings)) ]
    | Round { centre; radius } -> [ ("centre", On_map.pair centre); ("radius", Canonical.number radius) ]
  in
  `Assoc (("name", `String name) :: members)

let shapes full : (json, refusal) result =
  if (Unix.stat full).st_size > longest then refuse 413 "too-large" "this layer is too long"
  else
    let* source = Workspace.text full in
    let* outlines = Result.map_error (no_layer full) (Map_file.outlines ~path:full source) in
    Ok (`Assoc [ ("shapes", `List (List.rev (List.rev_map shape outlines))) ])

(* {1 Tiles} *)

let tiles full : (json, refusal) result =
  let* found = Result.map_error (no_layer full) (Tile_file.read full) in
  let bounds : json =
    match found.bounds with
    | Some (west, south, east, north) -> `List (List.map Canonical.number [ west; south; east; north ])
    | None -> `Null
  in
  Ok
    (`Assoc
       [ ("tiles", `Assoc [ ("minimum", `Int found.minimum); ("maximum", `Int found.maximum); ("bounds", bounds);
                            ("attribution", `String found.attribution) ]) ])

let layer w r =
  let* full = of_folder w r in
  Result.map (fun found -> json found) (if is_tiles full then tiles full else shapes full)

let number r name =
  let* text = parameter r name in
  match int_of_string_opt text with
  | Some n when n >= 0 -> Ok n
  | Some _ | None -> bad (name ^ " is a whole number")

let picture full ~zoom ~column ~row =
  match Tile_file.tile full ~zoom ~column ~row with
  | Ok (Some { kind; bytes }) -> Ok (Response.text ~kind 200 bytes)
  | Ok None -> refuse 404 "not-found" "there is no such tile"
  | Error why -> Error (no_layer full why)

let tile w r =
  let* full = of_folder w r in
  let* zoom = number r "zoom" in
  let* column = number r "column" in
  let* row = number r "row" in
  if is_tiles full then picture full ~zoom ~column ~row else bad "this layer has no tiles"

(* {1 Imports} *)

(* Twice as long on the wire, where a request has at most 4 MiB. *)
let longest_import = 1024 * 1024

let decoded text =
  let byte i = Char.chr (int_of_string ("0x" ^ String.sub text (2 * i) 2)) in
  let is_digit = function '0' .. '9' | 'a' .. 'f' -> true | _ -> false in
  if String.length text mod 2 = 0 && String.for_all is_digit text then Ok (String.init (String.length text / 2) byte)
  else bad "contents are hexadecimal digits, two for each byte"

(* The reply to the same file twice is the same: a page may repeat its request. *)
let store full bytes =
  let sentences e = String.concat "; " (Dolphin_app.Error.sentences e) in
  if not (Sys.file_exists full) then
    Result.map_error (fun e -> refusal 422 "not-saved" (sentences e))
      (Dolphin_app.Text_file.write full (fun channel -> output_string channel bytes))
  else
    match Dolphin_app.Text_file.read full with
    | Ok there when there = bytes -> Ok ()
    | Ok _ | Error _ -> refuse 409 "exists" (Filename.basename full ^ " is there with other contents: rename the file")

let import (w : Workspace.t) found =
  let* path = get Field.text "path" found in
  let* text = get Field.text "contents" found in
  let* bytes = decoded text in
  let* full = Result.map_error (refusal 404 "not-found") (Folder.place w.folder path) in
  if Folder.kind full <> Some Layer || is_tiles full then
    bad (Printf.sprintf "only maps are imported, which end in %s" (String.concat " " Folder.shapes))
  else if String.length bytes > longest_import then
    refuse 413 "too-large" (Printf.sprintf "a map of more than %d MiB is put into the folder by hand"
                              (longest_import / 1024 / 1024))
  else
    let* map = Result.map_error (no_layer full) (Map_file.read ~path:full bytes) in
    let* () = store full bytes in
    let names = Field.texts (List.map fst map.things) in
    Ok (`Assoc [ ("path", `String path); ("names", names); ("notes", Field.texts map.notes) ])
