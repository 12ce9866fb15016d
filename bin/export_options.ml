open Cmdliner
module Map_format = Dolphin_maps.Map_format

type t = { format : Map_format.t option; path : string option }

let names = String.concat ", " (List.map fst Map_format.all)

let format_conv =
  let parse text =
    match List.assoc_opt (String.lowercase_ascii text) Map_format.all with
    | Some format -> Ok format
    | None -> Error (`Msg (Printf.sprintf "'%s' is not one of the formats %s" text names))
  in
  let print ppf format = Format.pp_print_string ppf (fst (List.find (fun (_, f) -> f = format) Map_format.all)) in
  Arg.conv ~docv:"FORMAT" (parse, print)

let term =
  let format =
    let doc =
      "Write $(docv): $(b,csv), $(b,geojson), $(b,kml), $(b,gpx) or $(b,mcap). By default, the extension of \
       $(i,FILE) decides."
    in
    Arg.(value & opt (some format_conv) None & info [ "to" ] ~docv:"FORMAT" ~doc)
  in
  let path =
    let doc = "Write into $(docv), not to standard output." in
    Arg.(value & opt (some string) None & info [ "o"; "output" ] ~docv:"FILE" ~doc)
  in
  Term.(const (fun format path -> { format; path }) $ format $ path)

let format { format; path } =
  match format, path with
  | Some format, _ -> Ok format
  | None, Some path ->
    let why = Printf.sprintf "'%s' has no extension of a known format, %s: give --to FORMAT" path names in
    Option.to_result ~none:(Dolphin_app.Error.Bad_input why) (Map_format.of_path path)
  | None, None -> Error (Bad_input ("give --to FORMAT or -o FILE; the formats are " ^ names))

let man =
  `P "Positions are degrees and metres above the WGS 84 ellipsoid, times are UTC. $(b,geojson) is RFC 7946, with the \
      times of tracks as $(i,coordTimes). $(b,kml) has tracks as $(i,gx:MultiTrack), drawn on the ground. $(b,gpx) \
      has points as way points, plans as routes, tracks as tracks. $(b,csv) has a row for each position, as of RFC \
      4180. QGIS, GDAL, Google Earth and spreadsheets read them. $(b,mcap) is a recording for Foxglove: of each \
      vehicle its positions, $(i,foxglove.LocationFix), its battery and task, and its planned ways, \
      $(i,foxglove.GeoJSON); and the events, $(i,foxglove.Log)."
