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

(* The numbers of GPX are decimals. Some writers give small ones a power of ten, which can mean nothing else. *)
let with_powers points shapes =
  let has_power text = String.exists (fun c -> c = 'e' || c = 'E') text in
  let numbers p = text_of "ele" p :: List.filter_map (fun name -> List.assoc_opt name p.attributes) [ "lat"; "lon" ] in
  let add (first, n) text = if not (has_power text) then (first, n) else ((if n = 0 then text else first), n + 1) in
  match List.fold_left (fun found p -> List.fold_left add found (List.rev (numbers p))) ("", 0) points with
  | _, 0 -> shapes
  | first, n ->
    let others = if n = 1 then "is" else Printf.sprintf "and %d more are" (n - 1) in
    shapes @ [ Note (Printf.sprintf "'%s' %s read, although GPX does not allow a power of ten" first others) ]

let things x =
  let each ?(from = x) f = each ~name:(text_of "name" x) ~place:from.place f in
  match x.tag with
  | "wpt" -> each (fun () -> if has_no_place x then [ empty ] else with_powers [ x ] [ Spot (point x) ])
  | "rte" -> each (fun () -> some (with_powers (children "rtept" x) (way "rtept" x)))
  | "trk" ->
    (* Recorders begin segments that stay empty. *)
    let segment s = each ~from:s (fun () -> with_powers (children "trkpt" s) (way "trkpt" s)) in
    let found = List.concat_map segment (children "trkseg" x) in
    if found = [] then each (fun () -> [ empty ]) else found
  | _ -> []

let read text =
  let root = Xml_text.read text in
  if root.tag <> "gpx" then wrong root.place "this is not GPX: its root is '%s'" root.tag;
  List.concat_map things root.inside
