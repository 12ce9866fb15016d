(** The formats of files in which maps go to other programs. *)

type t = Csv | Geojson | Kml | Gpx | Mcap

val all : (string * t) list
(** By name: ["csv"], ["geojson"], ["kml"], ["gpx"], ["mcap"]. *)

val of_path : string -> t option
(** By the end of a file's name. *)
