(* Each package of dune-project depends on the packages whose libraries its own use, and on no others; the page of the
   interfaces names each library; a name of modules in two libraries has a row in docs/rationale.md. The arguments are
   dune-project, the page, the rationale, and the folders of the libraries. *)

open Dune_files

(* Those that come with the compiler. *)
let of_compiler = [ "unix"; "str"; "bigarray"; "threads" ]

(* The package of a library in opam's repository. All that we use begin with the package's name. *)
let opam_package all library =
  match named all library with
  | Some c -> Some c.package
  | None ->
    let root = List.hd (String.split_on_char '.' library) in
    if List.mem root of_compiler then None else Some root

(* The grammar needs a generator, besides a library. *)
let generators folder =
  let is_menhir = function List (Atom "menhir" :: _) -> true | List _ | Atom _ -> false in
  if List.exists is_menhir (parse (read (Filename.concat folder "dune"))) then [ "menhir" ] else []

let needed all ~root package =
  let of_component c =
    List.filter_map (opam_package all) c.uses @ generators (Filename.concat root c.folder)
  in
  let inside = List.filter (fun c -> c.package = package) all in
  List.sort_uniq String.compare (List.filter (fun p -> p <> package) (List.concat_map of_component inside))

(* Those that only tests need are not of interest, nor is the compiler. *)
let declared fields =
  let name = function
    | Atom a | List [ Atom a ] -> Some a
    | List [ Atom a; List [ Atom _; Atom _ ] ] -> Some a
    | List _ -> None
  in
  List.sort_uniq String.compare
    (List.filter (fun p -> p <> "ocaml") (List.filter_map name (field "depends" fields)))

(* The links to libraries that the page lacks. The command has no interface. *)
let unnamed page all =
  let link c = Printf.sprintf "{{:../%s/%s/index.html}" c.package (String.capitalize_ascii c.name) in
  let libraries = List.filter (fun c -> c.public <> c.package) all in
  List.filter (fun link -> not (has page link)) (List.map link libraries)

(* {1 Names of modules} *)

let rec modules folder =
  let inside entry =
    let path = Filename.concat folder entry in
    if entry.[0] = '.' then []
    else if Sys.is_directory path then if Sys.file_exists (Filename.concat path "dune") then [] else modules path
    else if List.exists (Filename.check_suffix entry) [ ".ml"; ".mll"; ".mly" ] then
      [ String.capitalize_ascii (Filename.remove_extension entry) ]
    else []
  in
  List.sort_uniq String.compare (List.concat_map inside (Array.to_list (Sys.readdir folder)))

(* The first cells of the table's rows. *)
let rows_of_shared ~root all =
  let libraries = List.filter (fun c -> c.public <> c.package) all in
  let named = List.concat_map (fun c -> List.map (fun m -> (m, c.folder)) (modules (Filename.concat root c.folder))) in
  let add rows (name, folder) =
    match rows with
    | (other, folders) :: rest when other = name -> (name, folder :: folders) :: rest
    | rows -> (name, [ folder ]) :: rows
  in
  let row (name, folders) =
    Printf.sprintf "| `%s` | %s |" name (String.concat ", " (List.rev_map (Printf.sprintf "`%s`") folders))
  in
  let grouped = List.fold_left add [] (List.sort compare (named libraries)) in
  List.rev_map row (List.filter (fun (_, folders) -> List.length folders > 1) grouped)

let is_prefix part line = String.length line >= String.length part && String.sub line 0 (String.length part) = part

(* Those of the folders that the page lacks, and those of the page that no folders have. *)
let wrong_rows ~root rationale all =
  let lines = List.filter (is_prefix "| `") (String.split_on_char '\n' rationale) in
  let rows = rows_of_shared ~root all in
  let lacking = List.filter (fun row -> not (List.exists (is_prefix row) lines)) rows in
  let stale = List.filter (fun line -> not (List.exists (fun row -> is_prefix row line) rows)) lines in
  List.map (fun row -> "lacks the row " ^ row) lacking @ List.map (fun line -> "has a row of no modules: " ^ line) stale

let () =
  match Array.to_list Sys.argv with
  | _ :: project :: page :: rationale :: (folder :: _ as folders) ->
    let all = List.concat_map (fun folder -> components ~shown:(Filename.basename folder) folder) folders in
    let packages = List.filter_map (function List (Atom "package" :: p) -> Some p | _ -> None) (parse (read project)) in
    let is_wrong fields =
      let package = String.concat "" (atoms (field "name" fields)) in
      let needed = needed all ~root:(Filename.dirname folder) package and declared = declared fields in
      let without xs = List.filter (fun p -> not (List.mem p xs)) in
      let missing = without declared needed and idle = without needed declared in
      List.iter (Printf.printf "dune-project: %s uses %s, and does not depend on it\n" package) missing;
      List.iter (Printf.printf "dune-project: %s depends on %s, and does not use it\n" package) idle;
      missing <> [] || idle <> []
    in
    if List.length packages < 2 then failwith "no packages are found in dune-project";
    let wrong = List.filter is_wrong packages and unnamed = unnamed (read page) all in
    List.iter (Printf.printf "%s does not name %s\n" page) unnamed;
    let rows = wrong_rows ~root:(Filename.dirname folder) (read rationale) all in
    List.iter (Printf.printf "%s %s\n" rationale) rows;
    if wrong <> [] || unnamed <> [] || rows <> [] then exit 1
  | _ -> failwith "usage: packages.exe DUNE-PROJECT PAGE RATIONALE FOLDER ..."
