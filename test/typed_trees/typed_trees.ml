let rec files folder =
  let path name = Filename.concat folder name in
  let of_name name = if Sys.is_directory (path name) then files (path name) else [ path name ] in
  List.concat_map of_name (List.sort String.compare (Array.to_list (Sys.readdir folder)))

let below ?(interfaces = false) folders =
  let is_tree path = Filename.check_suffix path ".cmt" || (interfaces && Filename.check_suffix path ".cmti") in
  match List.filter is_tree (List.concat_map files folders) with
  | [] -> failwith "no typed trees"
  | trees -> trees
