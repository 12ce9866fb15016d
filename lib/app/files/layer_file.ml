module Map_file = Dolphin_maps.Map_file

let ( let* ) = Result.bind

let read path =
  let wrong why = Error.Bad_input (Printf.sprintf "%s: %s" path why) in
  let* text = Text_file.read path in
  let* outlines = Result.map_error wrong (Map_file.outlines ~path text) in
  Ok { Dolphin_trace.Layer.name = Filename.remove_extension (Filename.basename path); outlines }
