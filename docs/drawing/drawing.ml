open Dune_files

(* {1 The graph} *)

let uses all c = List.filter_map (named all) c.uses

let rec reaches all target c = List.exists (fun d -> d.name = target.name || reaches all target d) (uses all c)

(* Without the arrows that other arrows make up for. *)
let arrows all c =
  let direct = uses all c in
  let is_needed d = not (List.exists (fun e -> e.name <> d.name && reaches all d e) direct) in
  List.filter is_needed direct

let rec height all c = List.fold_left (fun h d -> max h (1 + height all d)) 0 (uses all c)

let label c =
  match String.index_opt c.public '.' with
  | Some i -> String.sub c.public (i + 1) (String.length c.public - i - 1)
  | None -> c.public

(* Packages in the order of their highest library. *)
let draw all =
  let by_height c d = compare (- height all c, c.name) (- height all d, d.name) in
  let sorted = List.sort by_height all in
  let add packages c = if List.mem c.package packages then packages else c.package :: packages in
  let packages = List.rev (List.fold_left add [] sorted) in
  let node c = Printf.sprintf "    %s[%s]\n" c.name (label c) in
  let frame package =
    let inside = List.filter (fun c -> c.package = package) sorted in
    Printf.sprintf "  subgraph package-%s [%s]\n%s  end\n" package package (String.concat "" (List.map node inside))
  in
  let edges c = List.map (fun d -> Printf.sprintf "  %s --> %s\n" c.name d.name) (List.sort by_height (arrows all c)) in
  String.concat "" (("```mermaid\ngraph TD\n" :: List.map frame packages) @ List.concat_map edges sorted @ [ "```\n" ])

(* {1 The page} *)

(* Text between backquotes that begins with a folder is a path. *)
let wrong_paths folders page =
  let is_wrong quoted =
    let is_in folder =
      let name = Filename.basename folder ^ "/" in
      String.length quoted > String.length name
      && String.sub quoted 0 (String.length name) = name
      && quoted = String.lowercase_ascii quoted
      && not (Sys.file_exists (Filename.concat (Filename.dirname folder) quoted))
    in
    List.exists is_in folders
  in
  List.filteri (fun i quoted -> i mod 2 = 1 && is_wrong quoted) (String.split_on_char '`' page)

(* {1 Numbers of lines}

   A row of the table of files is [| number | what | `files` | lines |]; a file without a folder is in that of the file
   before it. *)

let quoted text = List.filteri (fun i _ -> i mod 2 = 1) (String.split_on_char '`' text)

let files text =
  let add (folder, found) name =
    let path = if String.contains name '/' then name else folder ^ "/" ^ name in
    (Filename.dirname path, path :: found)
  in
  List.rev (snd (List.fold_left add (".", []) (quoted text)))

let lines root path =
  List.length (String.split_on_char '\n' (read (Filename.concat root path))) - 1

(* A number stays until it is more than a sixth off. *)
let up_to_date shown counted = if 6 * abs (shown - counted) <= counted then shown else (counted + 5) / 10 * 10

let row root line =
  match String.split_on_char '|' line with
  | [ ""; number; what; names; shown; "" ] -> (
      match int_of_string_opt (String.trim number), int_of_string_opt (String.trim shown) with
      | Some _, Some shown ->
        let counted = List.fold_left (fun n path -> n + lines root path) 0 (files names) in
        String.concat "|" [ ""; number; what; names; Printf.sprintf " %d " (up_to_date shown counted); "" ]
      | _, _ -> line)
  | _ -> line

let with_lines root page = String.concat "\n" (List.map (row root) (String.split_on_char '\n' page))

let print page root all =
  let opening = "<!-- drawing -->\n" and ending = "<!-- end of drawing -->" in
  let start = find page opening + String.length opening and stop = find page ending in
  let drawn = String.sub page 0 start ^ draw all ^ String.sub page stop (String.length page - stop) in
  print_string (with_lines root drawn)

let check page folders all =
  let missing = List.filter (fun c -> not (has page ("| `" ^ c.folder ^ "` |"))) all in
  List.iter (fun c -> Printf.printf "architecture.md does not say what %s is\n" c.folder) missing;
  let wrong = wrong_paths folders page in
  List.iter (Printf.printf "architecture.md names %s, which is not there\n") wrong;
  if missing <> [] || wrong <> [] then exit 1

let () =
  match Array.to_list Sys.argv with
  | _ :: command :: page :: folders ->
    let page = read page in
    let all = List.concat_map (fun folder -> components ~shown:(Filename.basename folder) folder) folders in
    if command = "check" then check page folders all else print page (Filename.dirname (List.hd folders)) all
  | _ -> failwith "usage: drawing.exe (print | check) PAGE FOLDER ..."
