module Position = Dolphin_geo.Position
module Wgs84 = Dolphin_geo.Wgs84

type argument =
  | Number of float
  | Truth of bool
  | Text of string
  | Place of Position.t
  | Places of Position.t list

type item = { word : string; arguments : (string * argument) list }
type t = { name : string; vehicles : string list; items : item list }

let takes_photos item = List.mem item.word [ "capturePhoto"; "captureSeveralPhotos"; "captureUntilStop" ]
let required_payload m = if List.exists takes_photos m.items then [ "Camera" ] else []

let place_of item =
  let place = function
    | _, Place p | _, Places (p :: _) -> Some p
    | _, (Number _ | Truth _ | Text _ | Places []) -> None
  in
  List.find_map place item.arguments

let reference m = List.find_map place_of m.items
let is_numbered item = not (List.mem item.word [ "arm"; "altitude" ])

(* {1 Heights} *)

let optional name item =
  match List.assoc_opt name item.arguments with
  | Some (Number x) -> Some x
  | Some (Truth _ | Text _ | Place _ | Places _) | None -> None

(* Until a mission sets its height, it is at its home. Rounds that go up each time have no highest point. *)
let heights m =
  let climbs item = optional "up" item <> None and jumps item = item.word = "jumpToItem" in
  let is_known = not (List.exists climbs m.items && List.exists jumps m.items) in
  let add (height, i, found) item =
    let height =
      Option.value (optional "altitude" item) ~default:height +. Option.value (optional "up" item) ~default:0. in
    if not (is_numbered item) then (height, i, found)
    else (height, i + 1, (Printf.sprintf "%d.%s" i item.word, (if is_known then Some height else None)) :: found)
  in
  let _, _, found = List.fold_left add (0., 1, []) m.items in
  List.rev found

(* Above home, which is taken to be at height 0. A vehicle that lands is there. *)
let level item height : Plan.level =
  let height = if List.mem item.word [ "returnHomeAndLand"; "landingPoint" ] then Some 0. else height in
  { measured_from = (if height = None then Unspecified else Height); stays_at = Option.value height ~default:0.;
    amplitude = 0.; pitch = 0. }

(* {1 The way} *)

type leg = {
  item : string;
  waypoints : Position.t list;
  level : Plan.level;
  dwell : float;
  speed : float;
  radius : float;
}

let number name ~default item =
  match List.assoc_opt name item.arguments with
  | Some (Number x) -> x
  | Some (Truth _ | Text _ | Place _ | Places _) | None -> default

let place name ~default item =
  match List.assoc_opt name item.arguments with
  | Some (Place p) -> p
  | Some (Number _ | Truth _ | Text _ | Places _) | None -> default

let moved from item =
  Wgs84.displace from ~north:(number "north" ~default:0. item) ~east:(number "east" ~default:0. item)

type state = { here : Position.t; home : Position.t; now : float  (* its speed *) }

(* The default radius of a mission's circles. *)
let usual_radius = 50.

let radius item = match number "radius" ~default:0. item with 0. -> usual_radius | radius -> Float.abs radius
let circles turns ~speed item = turns *. 2. *. Float.pi *. radius item /. speed

let goes_round item =
  List.mem item.word [ "returnHomeAndLoiter"; "moveAndLoiter"; "loiterPos"; "loiterTurns"; "loiterTime" ]

(* Without a number of turns or seconds it never ends. *)
let loitering ~speed item =
  match number "turns" ~default:0. item, number "duration" ~default:0. item with
  | 0., 0. -> infinity
  | 0., seconds -> seconds
  | turns, _ -> circles turns ~speed item

let surveyed item =
  match List.assoc_opt "area" item.arguments with
  | Some (Places corners) ->
    Dolphin_geo.Survey.lines corners ~spacing:(number "spacing" ~default:20. item)
      ~bearing:(number "bearing" ~default:0. item)
  | Some (Number _ | Truth _ | Text _ | Place _) | None -> []

(* The state after [item], the places that it visits, and how long it stays at the last one. *)
let carry_out item s =
  let s = { s with now = number "speed" ~default:s.now item } in
  let go p dwell = ({ s with here = p }, [ p ], dwell) in
  let there = moved (place "position" ~default:s.here item) item in
  match item.word with
  | "speed" -> (s, [], 0.)
  | "home" -> ({ s with home = place "position" ~default:s.here item }, [], 0.)
  | "move" | "goPos" | "landingPoint" -> go there 0.
  | "moveFromHome" -> go (moved s.home item) 0.
  | "returnHome" | "returnHomeAndLand" -> go s.home 0.
  | "returnHomeAndLoiter" -> go s.home (loitering ~speed:s.now item)
  | "moveAndLoiter" | "loiterPos" | "loiterTurns" | "loiterTime" -> go there (loitering ~speed:s.now item)
  | "delay" -> (s, [], number "duration" ~default:0. item)
  | "surveyArea" -> (
      match surveyed item with
      | [] -> (s, [], 0.)
      | places -> ({ s with here = List.nth places (List.length places - 1) }, places, 0.))
  | _ -> (s, [], 0.)  (* items that neither move it nor take time: taking off, photos, heights *)

(* More than any vehicle's battery lasts for. *)
let most_steps = 20_000

type step = { index : int; leg : leg; taken : (int * float) list }

(* [jumps] is how often each jump was taken. *)
let steps ~from ~speed m =
  let items = Array.of_list (List.filter is_numbered m.items) in
  let heights = Array.of_list (List.map snd (heights m)) in
  let rec go i steps jumps s legs =
    let add leg = { index = i; leg; taken = jumps } :: legs in
    if i >= Array.length items then legs
    else
      let item = items.(i) in
      let named = Printf.sprintf "%d.%s" (i + 1) item.word in
      let level = level items.(i) heights.(i) in
      let stays = { item = named; waypoints = []; level; dwell = infinity; speed = s.now; radius = 0. } in
      if steps = most_steps then add stays
      else if item.word = "jumpToItem" then
        let taken = Option.value (List.assoc_opt i jumps) ~default:0. in
        let times = number "times" ~default:1. item in
        if times >= 0. && taken >= times then go (i + 1) (steps + 1) (List.remove_assoc i jumps) s legs
        else
          let target = int_of_float (number "item" ~default:1. item) - 1 in
          go target (steps + 1) ((i, taken +. 1.) :: List.remove_assoc i jumps) s legs
      else
        let s, waypoints, dwell = carry_out item s in
        let dwell = if dwell = infinity && i = Array.length items - 1 then 0. else dwell in
        let at_height (p : Position.t) =
          if level.measured_from = Unspecified then p else Position.at_height level.stays_at p in
        let radius = if goes_round item then radius item else 0. in
        let leg =
          { item = named; waypoints = List.rev (List.rev_map at_height waypoints); level; dwell; speed = s.now; radius }
        in
        go (i + 1) (steps + 1) jumps s (add leg)
  in
  List.rev (go 0 0 [] { here = from; home = from; now = speed } [])

let path ~from ~speed m = List.rev (List.rev_map (fun step -> step.leg) (steps ~from ~speed m))

let comes_home item = List.mem item.word [ "returnHome"; "returnHomeAndLand"; "returnHomeAndLoiter" ]

let last_before_home m =
  let items = Array.of_list (List.filter is_numbered m.items) in
  let steps from = steps ~from ~speed:1. m in
  let same s s' = List.equal Position.equal s.leg.waypoints s'.leg.waypoints in
  let is_last_part s = s.leg.waypoints = [] || comes_home items.(s.index) in
  let rec go last = function
    | s :: rest, s' :: rest' when same s s' ->
      go (match List.rev s.leg.waypoints with place :: _ -> Some place | [] -> last) (rest, rest')
    | rest, _ -> if List.for_all is_last_part rest then last else None
  in
  go None (steps Dolphin_geo.Place.apdl, steps Dolphin_geo.Place.feup)

(* Missions are plain data without functions or cycles. *)
let compare (a : t) (b : t) = Stdlib.compare a b

let pp ppf m =
  Format.fprintf ppf "%s: %a" m.name Fmt.(list ~sep:(any ", ") string) (List.map (fun item -> item.word) m.items)
