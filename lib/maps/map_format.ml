type t = Csv | Geojson | Kml | Gpx | Mcap

let all = [ ("csv", Csv); ("geojson", Geojson); ("kml", Kml); ("gpx", Gpx); ("mcap", Mcap) ]

let of_path path =
  match String.lowercase_ascii (Filename.extension path) with
  | "" -> None
  | ".json" -> Some Geojson
  | extension -> List.assoc_opt (String.sub extension 1 (String.length extension - 1)) all
