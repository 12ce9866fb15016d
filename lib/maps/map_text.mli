(** Maps as text, for other programs. Longitudes and latitudes are in degrees, to the eighth digit behind the point, a
    millimetre; heights in metres above the WGS 84 ellipsoid. *)

val geojson : Feature.t list -> string
(** RFC 7946, a feature a line. A line over the meridian of 180 degrees is cut there. The times of a track are its
    property [coordTimes], one for each position. *)

val kml : title:string -> Feature.t list -> string
(** KML 2.2; tracks are Google's [gx:MultiTrack]. All is drawn on the ground: KML counts heights from the sea. *)

val gpx : title:string -> Feature.t list -> string
(** GPX 1.1: points are way points, lines routes, tracks tracks. *)

val csv : string list -> Feature.property list list -> string
(** [csv columns rows], as of RFC 4180. *)

val rounded : int -> float -> float
(** [rounded n x] is [x] with [n] digits behind the point. *)
