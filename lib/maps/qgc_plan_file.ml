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
    each ~name:(Printf.sprintf "%s %d" word n) ~place (fun () -> [ shape () ])
  in
  List.concat_map one things

(* {1 The fence} *)

(* Without the member it is one to stay in, as QGroundControl reads it. *)
let on_side place json shape =
  match Json_text.member "inclusion" json with
  | `Bool false -> ("outside", place, shape)
  | `Bool true | `Null -> ("inside", place, shape)
  | _ -> ("fence", place, fun () -> wrong place "inclusion is true or false")

let fence json =
  let circle i json =
    let place = Printf.sprintf "circle %d of the fence" (i + 1) in
    let shape () =
      let circle = Json_text.member "circle" json in
      let radius = Json_text.number place (Json_text.member "radius" circle) in
      Round { centre = position place (Json_text.member "center" circle); radius }
    in
    on_side place json shape
  in
  let polygon i json =
    let place = Printf.sprintf "polygon %d of the fence" (i + 1) in
    on_side place json (fun () ->
        Ground [ { rim = positions place (Json_text.member "polygon" json); holes = [] } ])
  in
  let each name f = List.mapi f (listed ("the fence's " ^ name) (Json_text.member name json)) in
  each "polygons" polygon @ each "circles" circle

(* {1 The mission} *)

(* Commands of MAVLink that are flown to their place. Those of cameras, of regions of interest, of the home position
   and of markers for landings have a place, too, which is not part of the way. *)
let flown =
  [ (16, "WAYPOINT"); (17, "LOITER_UNLIM"); (18, "LOITER_TURNS"); (19, "LOITER_TIME"); (21, "LAND"); (22, "TAKEOFF");
    (31, "LOITER_TO_ALT"); (36, "ARC_WAYPOINT"); (82, "SPLINE_WAYPOINT"); (84, "VTOL_TAKEOFF"); (85, "VTOL_LAND");
    (94, "PAYLOAD_PLACE") ]

(* Height above the sea, home or ground; each also with whole numbers of 1e-7 degrees on the wire. *)
let global_frames = [ 0; 3; 5; 6; 10; 11 ]

let whole = function `Int n -> Some n | _ -> None

(* The place is the fifth to the seventh parameter; 0 and null mean none. *)
let place_of place item =
  match Json_text.elements place (Json_text.member "params" item) with
  | [ _; _; _; _; `Null; `Null; _ ] -> None
  | [ _; _; _; _; latitude; longitude; height ] ->
    let latitude = Json_text.number place latitude and longitude = Json_text.number place longitude in
    let height = if height = `Null then 0. else Json_text.number place height in
    if latitude = 0. && longitude = 0. then None else Some (Drawn.position place ~latitude ~longitude ~height)
  | params -> wrong place "an item has seven parameters, not %d" (List.length params)

(* A number that is missing or of another kind would leave a piece out of the way. *)
let number_of place item name =
  match whole (Json_text.member name item) with
  | Some n -> n
  | None -> wrong place "an item has a %s, a whole number" name

(* The part of the mission's way at this item, and the omissions. *)
let way_point (place, item) =
  match Json_text.member "type" item with
  | `Null | `String "SimpleItem" -> (
      match List.assoc_opt (number_of place item "command") flown with
      | None -> Either.Left None
      | Some command ->
        let frame = if Json_text.member "frame" item = `Null then 0 else number_of place item "frame" in
        if List.mem frame global_frames then Left (place_of place item)
        else Right (left_out place "%s in frame %d has no place on the globe" command frame))
  | _ -> Left None

let way items =
  let way, notes = List.partition_map way_point items in
  let line =
    match List.filter_map Fun.id way with
    | [] | [ _ ] -> []
    | way -> [ { name = "mission"; place = "the mission"; shape = Way way } ]
  in
  line @ List.concat notes

(* Surveys have an area or a line; QGroundControl computes their own way. *)
let complex (place, item) =
  let polygon = Json_text.member "polygon" item and line = Json_text.member "polyline" item in
  let word =
    match Json_text.member "complexItemType" item with
    | `String "CorridorScan" -> "corridor"
    | `String "StructureScan" -> "structure"
    | _ -> "survey"
  in
  match polygon, line with
  | `List _, _ -> [ (word, place, fun () -> Ground [ { rim = positions place polygon; holes = [] } ]) ]
  | _, `List _ -> [ (word, place, fun () -> Way (positions place line)) ]
  | _, _ -> []

let unknown (place, item) =
  let word json = match json with `String word -> word | _ -> "no type" in
  match Json_text.member "type" item with
  | `Null | `String "SimpleItem" -> []
  | `String "ComplexItem" when complex (place, item) <> [] -> []
  | `String "ComplexItem" -> (
      match word (Json_text.member "complexItemType" item) with
      | ("fwLandingPattern" | "vtolLandingPattern") as word ->
        left_out place "the landing pattern (%s) has no place on the map" word
      | word -> left_out place "%s has no area and no line" word)
  | kind -> left_out place "%s is not an item that is known here" (word kind)

let rally i p =
  let place = Printf.sprintf "rally point %d" (i + 1) in
  ("rally", place, fun () -> Spot (position place p))

let read text =
  let json = Json_text.read text in
  if Json_text.member "fileType" json <> `String "Plan" then
    wrong "" "this is not a plan of QGroundControl: it has no \"fileType\": \"Plan\"";
  let mission = Json_text.member "mission" json in
  let items =
    List.mapi (fun i item -> (Printf.sprintf "item %d of the mission" (i + 1), item))
      (listed "the mission's items" (Json_text.member "items" mission))
  in
  let home =
    match Json_text.member "plannedHomePosition" mission with
    | `Null -> []
    | home ->
      let place = "the home position" in
      each ~name:"home" ~place (fun () -> [ Spot (position place home) ])
  in
  let mission =
    try way items with Wrong { place; why } -> [ { name = "mission"; place; shape = Flawed why } ] in
  let rallies = listed "the rally points" (Json_text.member "points" (Json_text.member "rallyPoints" json)) in
  home @ mission @ List.concat_map unknown items
  @ numbered (List.concat_map complex items @ fence (Json_text.member "geoFence" json) @ List.mapi rally rallies)
