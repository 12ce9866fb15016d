let folder = "../../examples"

let names () =
  let program file = Filename.chop_suffix_opt ~suffix:".dol" file in
  List.sort String.compare (List.filter_map program (Array.to_list (Sys.readdir folder)))

let with_fleets () =
  List.filter (fun name -> Sys.file_exists (Filename.concat folder (name ^ ".fleet"))) (names ())
