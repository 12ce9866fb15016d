open Dolphin_app
open Dolphin_json
open Field
open Exchange
module Service = Dolphin_service.Service

let document (w : Workspace.t) found =
  let* path = get Field.text "path" found in
  let* full = Result.map_error (refusal 404 "not-found") (Folder.place w.folder path) in
  let* given = optional Field.text "text" found in
  let* source = match given with Some text -> Files.short text | None -> Workspace.text full in
  let of_fleet path = Option.map (fun text -> { Service.path; text }) (Result.to_option (Text_file.read path)) in
  let fleet = Option.bind (Workspace.fleet_path w ~program:full None) of_fleet in
  Ok (Documents.service ~file:full ~fleet ~may_read:(Folder.may_read w.folder) source)

let check w found =
  let* d = document w found in
  Ok (`Assoc [ ("diagnostics", Documents.diagnostics d) ])

let at_place f w found =
  let* d = document w found in
  let* at = get whole "at" found in
  Ok (f d at)

let definition (w : Workspace.t) found =
  let path file = of_option (fun path -> `String path) (Folder.inside w.folder file) in
  at_place (Documents.definition ~path) w found

let format w found =
  let* d = document w found in
  Result.map_error (refusal 422 "faults") (Documents.format d)

let shapes w found =
  let* d = document w found in
  Result.map_error (refusal 422 "faults") (Documents.shapes d)
