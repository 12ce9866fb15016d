let file name text : Text_file.file = { name; text; is_command = false }

let files =
  [ file "mission.dol" Template_files.program; file "mission.fleet" Template_files.fleet;
    file "README.md" Template_files.readme; { (file "check.sh" Template_files.check) with is_command = true };
    file ".github/workflows/mission.yml" Template_files.workflow ]

let is_free folder =
  match Sys.readdir folder with
  | files -> files = [||]
  | exception Sys_error _ -> not (Sys.file_exists folder)

let write folder =
  if is_free folder then Text_file.write_all folder files
  else Error (Error.Bad_input (folder ^ ": something is there; name a folder that is not there yet, or is empty"))
