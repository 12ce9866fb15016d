(* The name and the text of each file, and whether it is a command. *)
let files =
  [ ("mission.dol", Template_files.program, false); ("mission.fleet", Template_files.fleet, false);
    ("README.md", Template_files.readme, false); ("check.sh", Template_files.check, true);
    (".github/workflows/mission.yml", Template_files.workflow, false) ]

let is_free folder =
  match Sys.readdir folder with
  | files -> files = [||]
  | exception Sys_error _ -> not (Sys.file_exists folder)

let rec make folder =
  if not (Sys.file_exists folder) then begin
    make (Filename.dirname folder);
    Unix.mkdir folder 0o777
  end

(* Who may read a command may run it. *)
let write_file folder (name, text, is_command) =
  let path = Filename.concat folder name in
  make (Filename.dirname path);
  let written = Text_file.write path (fun channel -> output_string channel text) in
  if Result.is_ok written && is_command then begin
    let rights = (Unix.stat path).st_perm in
    Unix.chmod path (rights lor ((rights land 0o444) lsr 2))
  end;
  written

let write folder =
  if not (is_free folder) then
    Error (Error.Bad_input (folder ^ ": something is there; name a folder that is not there yet, or is empty"))
  else
    match List.fold_left (fun result file -> Result.bind result (fun () -> write_file folder file)) (Ok ()) files with
    | result -> result
    | exception Sys_error why -> Error (Error.Unavailable why)
    | exception Unix.Unix_error (error, _, _) ->
      Error (Error.Unavailable (Printf.sprintf "%s: %s" folder (Unix.error_message error)))
