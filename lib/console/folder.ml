type t = { root : string }

let root f = f.root

let make path =
  match Unix.realpath path with
  | root when Sys.is_directory root -> Ok { root }
  | _ -> Error (path ^ " is no folder")
  | exception Unix.Unix_error (error, _, _) -> Error (Printf.sprintf "%s: %s" path (Unix.error_message error))

type kind = Program | Fleet | Journal | Layer

(* Of all files in JSON few are maps. *)
let shapes = List.filter (( <> ) ".json") Dolphin_maps.Map_file.formats
let layers = ".mbtiles" :: shapes

let kind path =
  match Filename.extension path with
  | ".dol" | ".dolphin" -> Some Program
  | ".fleet" -> Some Fleet
  | ".run" -> Some Journal
  | extension -> if List.mem (String.lowercase_ascii extension) layers then Some Layer else None

(* {1 What there is} *)

(* A command that gets all names of the folder would take [-rf.dol] for an option; a line feed ends a line of a list. *)
let is_control c = Char.code c < 32 || c = '\127'
let is_hidden name = name = "" || List.mem name.[0] [ '.'; '_'; '-' ] || String.exists is_control name
let most_files = 2_000
let deepest = 8

let list f =
  let count = ref 0 in
  let rec below depth path =
    let full = Filename.concat f.root path in
    match Sys.readdir full with
    | exception Sys_error _ -> []
    | names ->
      Array.sort compare names;
      List.concat_map (item depth path) (List.filter (fun name -> not (is_hidden name)) (Array.to_list names))
  and item depth path name =
    let path = if path = "" then name else path ^ "/" ^ name in
    match Unix.lstat (Filename.concat f.root path), kind name with
    | { st_kind = S_DIR; _ }, _ when depth < deepest -> below (depth + 1) path
    | { st_kind = S_REG; st_nlink = 1; _ }, Some kind when !count < most_files -> incr count; [ (kind, path) ]
    | { st_kind = S_DIR | S_REG | S_LNK | S_CHR | S_BLK | S_FIFO | S_SOCK; _ }, _ -> []
    | exception Unix.Unix_error _ -> []
  in
  below 0 ""

(* {1 Where a file is} *)

let ( let* ) = Result.bind

let from_root f path =
  let before = if f.root = "/" then "/" else f.root ^ "/" in
  let n = String.length before in
  if String.length path > n && String.sub path 0 n = before then Some (String.sub path n (String.length path - n))
  else None

let refuse path why = Error (Printf.sprintf "%s: %s" (String.escaped path) why)

(* Names that can be meant: none hidden, none that leads elsewhere. *)
let plain path =
  let names = String.split_on_char '/' path in
  if String.length path > 1_000 || List.exists is_hidden names then refuse path "no such file is shown here"
  else if kind path = None then refuse path "this is neither a program nor a fleet nor a journal nor a layer"
  else Ok ()

(* The path below the root, too, of what [full] really is. *)
let real path full =
  match Unix.realpath full with
  | exception Unix.Unix_error (error, _, _) -> refuse path (Unix.error_message error)
  | full -> Ok full

let below_root f path full =
  Option.to_result ~none:(path ^ ": this is a link to somewhere else") (from_root f full)

(* Neither a pipe, which blocks its reader, nor another name of a file that may lie elsewhere. *)
let regular path full =
  match Unix.stat full with
  | { st_kind = S_REG; st_nlink = 1; _ } -> Ok ()
  | { st_kind = S_REG; _ } -> refuse path "this file has another name, a hard link: a copy of it would be shown"
  | { st_kind = S_DIR | S_LNK | S_CHR | S_BLK | S_FIFO | S_SOCK; _ } -> refuse path "this is not a regular file"
  | exception Unix.Unix_error (error, _, _) -> refuse path (Unix.error_message error)

let find f path =
  let* () = plain path in
  let* full = real path (Filename.concat f.root path) in
  let* below = below_root f path full in
  let* () = Result.map_error (fun _ -> String.escaped path ^ ": no such file is shown here") (plain below) in
  let* () = regular path full in
  Ok full

let place f path =
  let* () = plain path in
  if Sys.file_exists (Filename.concat f.root path) then find f path
  else
    let folder = Filename.dirname path in
    let* full = if folder = "." then Ok f.root else real path (Filename.concat f.root folder) in
    let* () =
      if full = f.root then Ok ()
      else
        let* below = below_root f path full in
        if List.exists is_hidden (String.split_on_char '/' below) then refuse path "no such folder" else Ok ()
    in
    if Sys.is_directory full then Ok (Filename.concat full (Filename.basename path)) else refuse path "no such folder"

(* What a text may name besides what is shown. *)
let is_map path = List.mem (String.lowercase_ascii (Filename.extension path)) Dolphin_maps.Map_file.formats

let may_read f path =
  let visible =
    let* full = real path path in
    let* below = below_root f path full in
    let names = String.split_on_char '/' below in
    let* () = regular path full in
    if List.exists is_hidden names || not (kind below <> None || is_map below) then refuse path "hidden" else Ok ()
  in
  Result.map_error (fun _ -> path ^ ": no such file in the folder of this console") visible

let inside f path =
  match Unix.realpath path with
  | exception Unix.Unix_error _ -> None
  | full ->
    let found path = match find f path with Ok _ -> Some path | Error _ -> None in
    Option.bind (from_root f full) found
