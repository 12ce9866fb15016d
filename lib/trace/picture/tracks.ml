open Summary
open Dolphin_geo

(* {1 The map} *)

(* Degrees from the middle of the map to picture units. The longitudes of a map have no seam: they may be beyond 180. *)
type map = {
  latitude : float;
  longitude : float;
  east : float;  (* units in a degree of longitude *)
  north : float;
  centre : float * float;
  metres : float;  (* in a unit *)
}

let metres_in_degree latitude =
  let at latitude longitude : Position.t = { latitude; longitude; height = 0. } in
  let low = Float.max (-89.) (Float.min 89. latitude) in
  let north = Wgs84.distance (at (low -. 0.01) 0.) (at (low +. 0.01) 0.) /. 0.02 in
  let east = Wgs84.distance (at low (-0.01)) (at low 0.01) /. 0.02 in
  (east, north)

(* [near longitude x] is [x] or the same meridian's other number, whichever is nearer to [longitude]. *)
let near longitude x = if x -. longitude > 180. then x -. 360. else if longitude -. x > 180. then x +. 360. else x

let project m (p : Position.t) =
  let x, y = m.centre in
  (x +. ((near m.longitude p.longitude -. m.longitude) *. m.east), y -. ((p.latitude -. m.latitude) *. m.north))

let least_span = 60.

let fit positions ~x ~y ~width ~height =
  match positions with
  | [] -> None
  | (first : Position.t) :: _ ->
    let latitudes = List.map (fun (p : Position.t) -> p.latitude) positions in
    let longitudes = List.map (fun (p : Position.t) -> near first.longitude p.longitude) positions in
    let least = List.fold_left Float.min infinity and most = List.fold_left Float.max neg_infinity in
    let latitude = (least latitudes +. most latitudes) /. 2. in
    let longitude = (least longitudes +. most longitudes) /. 2. in
    let east, north = metres_in_degree latitude in
    let span_east = Float.max least_span ((most longitudes -. least longitudes) *. east) in
    let span_north = Float.max least_span ((most latitudes -. least latitudes) *. north) in
    let metres = Float.max (span_east /. (width *. 0.72)) (span_north /. (height *. 0.78)) in
    let centre = (x +. (width /. 2.), y +. (height /. 2.)) in
    Some { latitude; longitude; east = east /. metres; north = north /. metres; centre; metres }

(* {1 Grid and scale} *)

let degrees decimals x ~positive ~negative =
  let x = if x > 180. then x -. 360. else if x < -180. then x +. 360. else x in
  let half = if Float.abs x < 1e-9 then "" else if x > 0. then positive else negative in
  Printf.sprintf "%.*f°%s" decimals (Float.abs x) half

let grid m ~x ~y ~width ~height =
  let middle_x, middle_y = m.centre in
  let across = width /. m.east and down = height /. m.north in
  let most length each = max 2 (int_of_float (length /. each)) in
  (* One step for both, so that cells look alike on neighbouring maps; near the poles meridians need a wider one. *)
  let step = Scale.step ~most:(most height 38.) down in
  let step_across = Float.max step (Scale.step ~most:(most width 62.) across) in
  let lines step origin span =
    Scale.multiples step ~from:(origin -. (span /. 2.)) ~until:(origin +. (span /. 2.))
  in
  let longitudes = lines step_across m.longitude across and latitudes = lines step m.latitude down in
  let meridian longitude =
    let at = middle_x +. ((longitude -. m.longitude) *. m.east) in
    let label = degrees (Scale.decimals step_across) longitude ~positive:"E" ~negative:"W" in
    let fits = at > x +. 24. && at < x +. width -. 24. in
    Svg.line ~name:"grid" (at, y) (at, y +. height)
    :: (if fits then [ Svg.text ~name:"axis" ~anchor:Middle (at, y +. height +. 13.) label ] else [])
  in
  let parallel latitude =
    let at = middle_y -. ((latitude -. m.latitude) *. m.north) in
    let label = degrees (Scale.decimals step) latitude ~positive:"N" ~negative:"S" in
    [ Svg.line ~name:"grid" (x, at) (x +. width, at); Svg.text ~name:"axis" ~anchor:End (x -. 6., at +. 3.5) label ]
  in
  List.concat_map meridian longitudes @ List.concat_map parallel latitudes

let scale m ~x ~y ~width ~height =
  let metres = Scale.step ~most:1 (width *. m.metres *. 0.09) in
  let length = metres /. m.metres in
  let label = if metres >= 1000. then Printf.sprintf "%g km" (metres /. 1000.) else Printf.sprintf "%g m" metres in
  let right = x +. width -. 12. and base = y +. height -. 12. in
  let n = Svg.number in
  [ Svg.rect ~name:"halo" ~x:(right -. length -. 8.) ~y:(base -. 22.) ~width:(length +. 16.) ~height:30. ();
    Svg.path ~name:"ruler"
      (Printf.sprintf "M%s,%s v5 h%s v-5" (n (right -. length)) (n (base -. 4.)) (n length));
    Svg.text ~name:"axis" ~anchor:Middle (right -. (length /. 2.), base -. 8.) label ]

(* {1 Ways} *)

(* Points nearer than this to the last one that is drawn are left out. *)
let near_enough = 0.8

let thin points =
  let far (x, y) (x', y') = Float.abs (x -. x') +. Float.abs (y -. y') >= near_enough in
  let add kept point = match kept with last :: _ when not (far last point) -> kept | kept -> point :: kept in
  match points with
  | [] -> []
  | first :: rest ->
    let kept = List.fold_left add [ first ] rest in
    let last = List.fold_left (fun _ p -> p) first rest in
    List.rev (match kept with k :: _ when k = last -> kept | kept -> last :: kept)

(* Of a list that is not empty. *)
let last xs = List.nth xs (List.length xs - 1)

let planned m i v =
  let of_task (t : task) =
    match t.way with
    | Some (Path (_ :: _ :: _ as ps)) ->
      let tip = Printf.sprintf "%s was to go this way: %s" v.id t.plan in
      [ Svg.polyline ~name:("planned " ^ Style.vehicle i) ~tip (thin (List.map (project m) ps)) ]
    | Some (Path ([] | [ _ ]) | By_name) | None -> []
  in
  List.concat_map of_task v.tasks

(* [parts is_so xs] is [xs], cut so that all neighbours in a part are of the same kind. A cut belongs to both sides. *)
let parts is_so xs =
  let rec go kind part found = function
    | a :: (b :: _ as rest) ->
      let next = is_so a b in
      if part = [] || next = kind then go next (a :: part) found rest
      else go next [ a ] ((kind, a :: part) :: found) rest
    | [ a ] -> List.rev ((kind, a :: part) :: found)
    | [] -> List.rev found
  in
  List.map (fun (kind, part) -> (kind, List.rev part)) (go false [] [] xs)

let way summary m i v =
  let colour = Style.vehicle i in
  let point s = project m s.position in
  let runs = runs v in
  let invented = List.filter (is_invented summary) v.tasks in
  let is_invented (a : sample) (b : sample) =
    List.exists (fun (t : task) -> t.from < b.time && a.time < t.until) invented
  in
  let seen (is_invented, run) =
    Svg.polyline ~name:((if is_invented then "track invented " else "track ") ^ colour) (thin (List.map point run)) in
  let rec jumps = function
    | run :: (next :: _ as others) ->
      let from = point (last run) and until = point (List.hd next) in
      Svg.line ~name:("track unseen " ^ colour) from until :: jumps others
    | [ _ ] | [] -> []
  in
  let starts =
    let start ((t : task), p) =
      let tip = Printf.sprintf "%s starts %s at %s" v.id t.plan (Phrase.time t.from) in
      Svg.circle ~name:("step " ^ colour) ~tip (project m p) 2.4
    in
    List.map start (places v)
  in
  let ends =
    match v.samples with
    | [] -> []
    | first :: _ as samples ->
      [ Svg.circle ~name:("first " ^ colour) ~tip:(v.id ^ " at first") (point first) 4.;
        Svg.circle ~name:("last " ^ colour) ~tip:(v.id ^ " at last") (point (last samples)) 4.5 ]
  in
  Style.group i (List.map seen (List.concat_map (parts is_invented) runs) @ jumps runs @ starts @ ends)

(* Further names are not distinguished on a map: the timeline has them. *)
let most_names = 60

let line_height = 13.
let height_for count = if count > most_names then 0. else (float_of_int count *. line_height) +. 16.

(* Names stand beside where the vehicles are at last, one below the other where these are close. *)
let names m vehicles ~x ~width ~y ~height =
  let wanted i v =
    match List.rev v.samples with
    | [] -> None
    | last :: _ ->
      let px, py = project m last.position in
      Some (py +. 4., (i, v, (px, py)))
  in
  let wanted = List.filter_map Fun.id (List.mapi wanted vehicles) in
  let label (at, (i, v, (px, py))) =
    let text = Svg.fit 120. v.id in
    let leftwards = px +. 10. +. Svg.width ~size:12. text > x +. width in
    let anchor, dx = if leftwards then (Svg.End, -9.) else (Svg.Start, 9.) in
    let beside = (px +. dx, at -. 4.) in
    (* A name that had to move away has a line to its vehicle. *)
    let leader = if Float.abs (at -. 4. -. py) < 8. then [] else [ Svg.line ~name:"leader" (px, py) beside ] in
    Style.group i (leader @ [ Svg.text ~name:("name on-map " ^ Style.vehicle i) ~anchor (px +. dx, at) text ])
  in
  if List.length wanted > most_names then []
  else List.map label (Scale.spread ~least:line_height ~from:(y +. 12.) ~until:(y +. height -. 4.) wanted)

(* {1 Fences and layers} *)

let fences summary = match summary.header with Some (h : Header.t) -> h.fences | None -> []

let rims (fence : Dolphin_plans.Fences.fence) =
  match fence.rule with
  | Inside (Circle _ as area) | Outside (Circle _ as area) -> [ Area.corners area ]
  | Inside (Shape shape) | Outside (Shape shape) -> Area.rings shape
  | Depth _ | Height _ | Distance _ -> []

(* A fence that is much wider than what vehicles did, or a coast, would leave nothing of that to see: only its sides
   near it are on the map then. *)
let most_wider = 2.

let in_view positions shapes =
  match fit positions ~x:0. ~y:0. ~width:1. ~height:1. with
  | None -> []
  | Some m ->
    let is_near p =
      let x, y = project m p in
      Float.abs (x -. 0.5) <= most_wider /. 2. && Float.abs (y -. 0.5) <= most_wider /. 2. in
    List.concat_map (fun shape -> if List.for_all is_near shape then shape else []) shapes

let around summary =
  List.map (fun fence -> List.concat (rims fence)) (fences summary) @ List.concat_map Layer.places summary.layers

(* Layers below. *)
let draw_below m summary ~x ~y ~width ~height =
  let commands rim =
    let point (x, y) = Svg.number x ^ "," ^ Svg.number y in
    "M" ^ String.concat " L" (List.map point (thin (List.map (project m) rim))) ^ " Z"
  in
  let shape (fence : Dolphin_plans.Fences.fence) =
    match fence.rule, rims fence with
    | (Depth _ | Height _ | Distance _), _ | _, [] -> []
    | rule, rims ->
      let name = match rule with Outside _ -> "fence no-go" | _ -> "fence" in
      [ Svg.path ~name ~tip:fence.text (String.concat " " (List.map commands rims)) ]
  in
  let layer = Layer.draw ~project:(project m) ~thin ~left:x ~right:(x +. width) ~top:y ~bottom:(y +. height) in
  match List.concat (List.mapi layer summary.layers) @ List.concat_map shape (fences summary) with
  | [] -> []
  | shapes ->
    [ Svg.element "clipPath" [ ("id", "chart") ] [ Svg.rect ~x ~y ~width ~height () ];
      Svg.element "g" [ ("clip-path", "url(#chart)") ] shapes ]

let map_of summary ~x ~y ~width ~height =
  let planned (t : task) = match t.way with Some (Path ps) -> ps | Some By_name | None -> [] in
  let of_vehicle v =
    if v.samples = [] then [] else List.map (fun s -> s.position) v.samples @ List.concat_map planned v.tasks in
  let positions = List.concat_map of_vehicle summary.vehicles in
  fit (positions @ in_view positions (around summary)) ~x ~y ~width ~height

(* For a vehicle at rest, the first and the last moment are enough. *)
let over_time m v =
  let point s = (s.time, project m s.position) in
  let far (_, (x, y)) (_, (x', y')) = Float.abs (x -. x') +. Float.abs (y -. y') >= near_enough in
  let rec keep last = function
    | a :: (b :: _ as rest) when (not (far last a)) && not (far last b) -> keep last rest
    | a :: rest -> a :: keep a rest
    | [] -> []
  in
  match List.map point v.samples with [] -> [] | first :: rest -> first :: keep first rest

let moments summary ~x ~y ~width ~height =
  match map_of summary ~x ~y ~width ~height with
  | None -> List.map (fun _ -> []) summary.vehicles
  | Some m -> List.map (over_time m) summary.vehicles

(* {1 What lines mean} *)

let has_planned v =
  let is_planned (t : task) = match t.way with Some (Path (_ :: _ :: _)) -> true | Some _ | None -> false in
  v.samples <> [] && List.exists is_planned v.tasks

let meanings summary =
  let is_seen v = v.samples <> [] && List.exists (is_invented summary) v.tasks in
  (if List.exists has_planned summary.vehicles then [ ("key planned", "planned"); ("key flown", "flown") ] else [])
  @
  if List.exists is_seen summary.vehicles then
    [ ("key flown invented", "invented by the simulator: it knows these plans by name only") ]
  else []

(* Fences that are areas have a line each way; the others are nowhere on the map. *)
let meanings_of_fences summary =
  let has is_it = List.exists (fun (f : Dolphin_plans.Fences.fence) -> is_it f.rule) (fences summary) in
  let inside : Dolphin_plans.Fences.rule -> bool = function
    | Inside _ -> true | Outside _ | Depth _ | Height _ | Distance _ -> false in
  let outside : Dolphin_plans.Fences.rule -> bool = function
    | Outside _ -> true | Inside _ | Depth _ | Height _ | Distance _ -> false in
  (if has inside then [ ("fence", "fence: stay inside") ] else [])
  @ if has outside then [ ("fence no-go", "fence: stay outside") ] else []

let meanings_of_layers summary =
  List.mapi (fun i (layer : Layer.t) -> (Layer.key i, Svg.fit 160. layer.name)) summary.layers

let legend summary ~x ~y =
  let one (x, found) (name, text) =
    let line = Svg.line ~name (x, y -. 3.5) (x +. 20., y -. 3.5) in
    (x +. 40. +. Svg.width ~size:10. text, found @ [ line; Svg.text ~name:"axis" (x +. 26., y) text ])
  in
  snd (List.fold_left one (x, []) (meanings summary @ meanings_of_fences summary @ meanings_of_layers summary))

let draw summary ~x ~y ~width ~height =
  let frame = Svg.rect ~name:"frame" ~x ~y ~width ~height () in
  let parts =
    match map_of summary ~x ~y ~width ~height with
    | None -> [ Svg.text ~name:"small" ~anchor:Middle (x +. (width /. 2.), y +. (height /. 2.)) "no positions" ]
    | Some m ->
      grid m ~x ~y ~width ~height
      @ draw_below m summary ~x ~y ~width ~height
      @ List.mapi (fun i v -> Style.group i (planned m i v)) summary.vehicles
      @ List.mapi (way summary m) summary.vehicles
      @ names m summary.vehicles ~x ~width ~y ~height
      @ scale m ~x ~y ~width ~height
  in
  Svg.group ~name:"tracks" (parts @ [ frame ])
