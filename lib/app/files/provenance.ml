let members ~version (program : Program_file.t) (fleet : Fleet_file.t) : Dolphin_json.Field.members =
  let digest text = `String (Digest.to_hex (Digest.string text)) in
  [ ("version", `String version); ("program", digest program.source); ("fleet", digest fleet.source);
    ("set", `Assoc (List.map (fun (x, value) -> (x, `String value)) program.set)) ]
