open Drawn
open Xml_text

let point x =
  let degrees name =
    match List.assoc_opt name x.attributes with
    | Some text -> number x text
    | None -> wrong x.place "a point has the attributes lat and lon"
  in
  let height = match text_of "ele" x with "" -> 0. | text -> number x text in
  Drawn.position x.place ~latitude:(degrees "lat") ~longitude:(degrees "lon") ~height

(* Of one point, it is that. *)
let way tag x =
  match List.rev (List.rev_map point (children tag x)) with
  | [] -> []
  | [ p ] -> [ Spot p ]
  | ps -> [ Way ps ]

let things x =
  let shapes =
    match x.tag with
    | "wpt" -> [ Spot (point x) ]
    | "rte" -> way "rtept" x
    | "trk" -> List.concat_map (way "trkpt") (children "trkseg" x)
    | _ -> []
  in
  List.map (fun shape -> { name = text_of "name" x; place = x.place; shape }) shapes

let read text =
  let root = Xml_text.read text in
  if root.tag <> "gpx" then wrong root.place "this is no GPX: its root is '%s'" root.tag;
  List.concat_map things root.inside
