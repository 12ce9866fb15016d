open Drawn

let position = Json_text.position Latitude_first
let positions place json = List.map (position place) (Json_text.elements place json)

let listed place json = match json with `Null -> [] | json -> Json_text.elements place json

(* ["outside 1"] and ["inside 1"], each with a number of its own. *)
let numbered things =
  let count = Hashtbl.create 4 in
  let one (word, place, shape) =
    let n = 1 + Option.value (Hashtbl.find_opt count word) ~default:0 in
    Hashtbl.replace count word n;
    { name = Printf.sprintf "%s %d" word n; place; shape }
  in
  List.map one things

let side json = match Json_text.member "inclusion" json with `Bool false -> "outside" | _ -> "inside"

let fence json =
  let circle i json =
    let place = Printf.sprintf "circle %d of the fence" (i + 1) in
    let circle = Json_text.member "circle" json in
    let radius = Json_text.number place (Json_text.member "radius" circle) in
    (side json, place, Round { centre = position place (Json_text.member "center" circle); radius })
  in
  let polygon i json =
    let place = Printf.sprintf "polygon %d of the fence" (i + 1) in
    (side json, place, Ground [ { rim = positions place (Json_text.member "polygon" json); holes = [] } ])
  in
  let each name f = List.mapi f (listed ("the fence's " ^ name) (Json_text.member name json)) in
  each "polygons" polygon @ each "circles" circle

(* Items of MAVLink have their position as the fifth to the seventh parameter; 0 and null are none. *)
let way_point place item =
  match Json_text.member "params" item with
  | `List [ _; _; _; _; latitude; longitude; height ] when latitude <> `Null && longitude <> `Null ->
    let latitude = Json_text.number place latitude and longitude = Json_text.number place longitude in
    let height = if height = `Null then 0. else Json_text.number place height in
    if latitude = 0. && longitude = 0. then None else Some (Drawn.position place ~latitude ~longitude ~height)
  | _ -> None

let complex place item =
  let polygon = Json_text.member "polygon" item and line = Json_text.member "polyline" item in
  let word =
    match Json_text.member "complexItemType" item with
    | `String "CorridorScan" -> "corridor"
    | `String "StructureScan" -> "structure"
    | _ -> "survey"
  in
  match polygon, line with
  | `List _, _ -> [ (word, place, Ground [ { rim = positions place polygon; holes = [] } ]) ]
  | _, `List _ -> [ (word, place, Way (positions place line)) ]
  | _, _ -> []

let read text =
  let json = Json_text.read text in
  if Json_text.member "fileType" json <> `String "Plan" then
    wrong "" "this is no plan of QGroundControl: it has no \"fileType\": \"Plan\"";
  let mission = Json_text.member "mission" json in
  let items =
    List.mapi (fun i item -> (Printf.sprintf "item %d of the mission" (i + 1), item))
      (listed "the mission's items" (Json_text.member "items" mission))
  in
  let home =
    match Json_text.member "plannedHomePosition" mission with
    | `Null -> []
    | home -> [ { name = "home"; place = "the home position"; shape = Spot (position "the home position" home) } ]
  in
  let way =
    match List.filter_map (fun (place, item) -> way_point place item) items with
    | [] | [ _ ] -> []
    | way -> [ { name = "mission"; place = "the mission"; shape = Way way } ]
  in
  let rally i p =
    let place = Printf.sprintf "rally point %d" (i + 1) in
    ("rally", place, Spot (position place p))
  in
  let rallies = listed "the rally points" (Json_text.member "points" (Json_text.member "rallyPoints" json)) in
  home @ way
  @ numbered
    (List.concat_map (fun (place, item) -> complex place item) items
     @ fence (Json_text.member "geoFence" json)
     @ List.mapi rally rallies)
