(* The name, the text and the rights of each file. *)
let files =
  [ ("mission.dol", Template_files.program, 0o644); ("mission.fleet", Template_files.fleet, 0o644);
    ("README.md", Template_files.readme, 0o644); ("check.sh", Template_files.check, 0o755);
    (".github/workflows/mission.yml", Template_files.workflow, 0o644) ]

let is_free folder =
  match Sys.readdir folder with
  | files -> files = [||]
  | exception Sys_error _ -> not (Sys.file_exists folder)

let rec make folder =
  if not (Sys.file_exists folder) then begin
    make (Filename.dirname folder);
    Unix.mkdir folder 0o777
  end

let write_file folder (name, text, rights) =
  let path = Filename.concat folder name in
  make (Filename.dirname path);
  let channel = open_out_gen [ Open_wronly; Open_creat; Open_excl; Open_binary ] rights path in
  Fun.protect ~finally:(fun () -> close_out_noerr channel) (fun () -> output_string channel text; close_out channel)

let write folder =
  if not (is_free folder) then
    Error (Error.Bad_input (folder ^ ": something is there; name a folder that is not there yet, or is empty"))
  else
    match List.iter (write_file folder) files with
    | () -> Ok ()
    | exception Sys_error why -> Error (Error.Unavailable why)
    | exception Unix.Unix_error (error, _, _) ->
      Error (Error.Unavailable (Printf.sprintf "%s: %s" folder (Unix.error_message error)))
