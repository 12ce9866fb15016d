open Drawn
open Xml_text

let point x =
  let degrees name =
    match List.assoc_opt name x.attributes with
    | Some text -> number x text
    | None -> wrong x.place "a point has the attributes lat and lon"
  in
  let height = match text_of "ele" x with "" -> 0. | text -> number x text in
  let latitude = degrees "lat" in
  Drawn.position x.place ~latitude ~longitude:(degrees "lon") ~height

(* Of one point, it is that. *)
let way tag x =
  match List.rev (List.rev_map point (children tag x)) with
  | [] -> []
  | [ p ] -> [ Spot p ]
  | ps -> [ Way ps ]

(* Writers give a way point without a place empty attributes, or none. *)
let has_no_place x =
  let is_empty name = Option.value (List.assoc_opt name x.attributes) ~default:"" = "" in
  is_empty "lat" && is_empty "lon"

let things x =
  let each ?(from = x) f = each ~name:(text_of "name" x) ~place:from.place f in
  match x.tag with
  | "wpt" -> each (fun () -> if has_no_place x then [ empty ] else [ Spot (point x) ])
  | "rte" -> each (fun () -> some (way "rtept" x))
  | "trk" ->
    (* Recorders begin segments that stay empty. *)
    let segment s = each ~from:s (fun () -> way "trkpt" s) in
    let found = List.concat_map segment (children "trkseg" x) in
    if found = [] then each (fun () -> [ empty ]) else found
  | _ -> []

let read text =
  let root = Xml_text.read text in
  if root.tag <> "gpx" then wrong root.place "this is not GPX: its root is '%s'" root.tag;
  List.concat_map things root.inside
