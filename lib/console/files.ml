open Dolphin_app
open Dolphin_json
open Field
open Exchange
module Request = Dolphin_http.Request

let hash text = Digest.to_hex (Digest.string text)

let list (w : Workspace.t) _ =
  let of_kind kind =
    let wanted (k, path) = if k = kind then Some (`String path) else None in
    `List (List.filter_map wanted (Folder.list w.folder))
  in
  Ok (`Assoc [ ("programs", of_kind Folder.Program); ("fleets", of_kind Fleet); ("journals", of_kind Journal);
               ("layers", of_kind Layer) ])

let read w r =
  let* path = parameter r "path" in
  let* full = Workspace.file w path in
  let* text =
    match Folder.kind full with
    | Some Journal -> bad "journals are shown by replay"
    | Some Layer -> bad "layers are shown by layer"
    | Some (Program | Fleet) | None -> Workspace.text full
  in
  Ok (`Assoc [ ("path", `String path); ("text", `String text); ("hash", `String (hash text)) ])

let longest_text = 256 * 1024

let short text =
  if String.length text <= longest_text then Ok text
  else refuse 413 "too-large" (Printf.sprintf "a text has at most %d bytes here" longest_text)

(* A client sends the hash of the text that it read: changes by others meanwhile are not lost. *)
let save (w : Workspace.t) found =
  let* path = get Field.text "path" found in
  let* text = Result.bind (get Field.text "text" found) short in
  let* before = optional Field.text "hash" found in
  let* full = Result.map_error (refusal 404 "not-found") (Folder.place w.folder path) in
  let* () =
    match Folder.kind full with
    | Some (Journal | Layer) -> bad "journals and layers are not edited"
    | Some (Program | Fleet) | None -> Ok ()
  in
  let there = if Sys.file_exists full then Result.to_option (Text_file.read full) else None in
  if Option.map hash there <> before then
    refuse 409 "changed" "the file has changed since it was read"
      ~more:[ ("hash", of_option (fun text -> `String (hash text)) there) ]
  else
    let written =
      if there = None then Text_file.write full (fun channel -> output_string channel text)
      else Source_file.replace full text
    in
    match written with
    | Ok () -> Ok (`Assoc [ ("hash", `String (hash text)) ])
    | Error e -> refuse 422 "not-saved" (String.concat "; " (Error.sentences e))
