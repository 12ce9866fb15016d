type t = { root : string }

let root f = f.root

let make path =
  match Unix.realpath path with
  | root when Sys.is_directory root -> Ok { root }
  | _ -> Error (path ^ " is no folder")
  | exception Unix.Unix_error (error, _, _) -> Error (Printf.sprintf "%s: %s" path (Unix.error_message error))

type kind = Program | Fleet | Journal | Layer

(* Of all files in JSON few are maps. *)
let layers = ".mbtiles" :: List.filter (( <> ) ".json") Dolphin_maps.Map_file.formats

let kind path =
  match Filename.extension path with
  | ".dol" | ".dolphin" -> Some Program
  | ".fleet" -> Some Fleet
  | ".run" -> Some Journal
  | extension -> if List.mem (String.lowercase_ascii extension) layers then Some Layer else None

(* {1 What there is} *)

let is_hidden name = name = "" || name.[0] = '.' || name.[0] = '_'
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
    match (Unix.lstat (Filename.concat f.root path)).st_kind, kind name with
    | S_DIR, _ when depth < deepest -> below (depth + 1) path
    | S_REG, Some kind when !count < most_files -> incr count; [ (kind, path) ]
    | (S_DIR | S_REG | S_LNK | S_CHR | S_BLK | S_FIFO | S_SOCK), _ -> []
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
  if String.length path > 1_000 || String.contains path '\000' || List.exists is_hidden names then
    refuse path "no such file is shown here"
  else if kind path = None then refuse path "this is neither a program nor a fleet nor a journal nor a layer"
  else Ok ()

let real f path =
  match Unix.realpath (Filename.concat f.root path) with
  | exception Unix.Unix_error (error, _, _) -> refuse path (Unix.error_message error)
  | full -> (
      match from_root f full with
      | Some _ -> Ok full
      | None -> refuse path "this is a link to somewhere else")

let is_file path =
  match (Unix.stat path).st_kind with
  | S_REG -> true
  | S_DIR | S_LNK | S_CHR | S_BLK | S_FIFO | S_SOCK -> false
  | exception Unix.Unix_error _ -> false

let find f path =
  let* () = plain path in
  let* full = real f path in
  if is_file full && kind full <> None then Ok full else refuse path "this is no file"

let place f path =
  let* () = plain path in
  if Sys.file_exists (Filename.concat f.root path) then find f path
  else
    let folder = Filename.dirname path in
    let* full = if folder = "." then Ok f.root else real f folder in
    if Sys.is_directory full then Ok (Filename.concat full (Filename.basename path)) else refuse path "no such folder"

let may_read f path =
  let is_inside = match Unix.realpath path with
    | full -> from_root f full <> None
    | exception Unix.Unix_error _ -> false
  in
  if is_inside then Ok () else Error (path ^ ": there is no such file in the folder of this console")

let inside f path =
  match Unix.realpath path with
  | exception Unix.Unix_error _ -> None
  | full ->
    let found path = match find f path with Ok _ -> Some path | Error _ -> None in
    Option.bind (from_root f full) found
