open Dolphin_geo
module Location = Dolphin_syntax.Location

type rule = Inside of Area.t | Outside of Area.t | Depth of float | Height of float | Distance of float

let equal_rule a b =
  match a, b with
  | Inside a, Inside b | Outside a, Outside b -> Area.equal a b
  | Depth x, Depth y | Height x, Height y | Distance x, Distance y -> Float.equal x y
  | (Inside _ | Outside _ | Depth _ | Height _ | Distance _), _ -> false

type fence = { rule : rule; margin : float; text : string; at : Location.t }

(* [on_ground] are the fences of the rules of [planned] and [seen], by number: with margins, and without. [limits] are
   those of depth and height. *)
type t = { all : fence list; on_ground : fence array; limits : fence array; planned : Fence.t; seen : Fence.t }

let area_rule fence : Fence.rule option =
  match fence.rule with
  | Inside area -> Some { side = Inside; area; margin = fence.margin }
  | Outside area -> Some { side = Outside; area; margin = fence.margin }
  | Depth _ | Height _ | Distance _ -> None

let make all =
  let on_ground = List.filter_map (fun fence -> Option.map (fun rule -> (fence, rule)) (area_rule fence)) all in
  let rules = List.map snd on_ground in
  let is_limit fence = match fence.rule with Depth _ | Height _ -> true | Inside _ | Outside _ | Distance _ -> false in
  let planned = Fence.make rules in
  { all; on_ground = Array.of_list (List.map fst on_ground); limits = Array.of_list (List.filter is_limit all);
    planned; seen = Fence.without_margins planned }

let none = make []
let list fences = fences.all
let is_none fences = fences.all = []

let least_distance fences =
  let wider best fence =
    match fence.rule, best with
    | Distance _, None -> Some fence
    | Distance metres, Some { rule = Distance least; _ } when metres > least -> Some fence
    | (Inside _ | Outside _ | Depth _ | Height _ | Distance _), _ -> best
  in
  List.fold_left wider None fences.all

(* {1 Words} *)

let longest_text = 60

(* Between two characters of UTF-8. *)
let rec cut text n = if n > 0 && Char.code text.[n] land 0xC0 = 0x80 then cut text (n - 1) else String.sub text 0 n
let shortened text = if String.length text <= longest_text then text else cut text (longest_text - 3) ^ "..."

let named fence =
  let text = shortened fence.text in
  if fence.at = Location.none then text
  else Printf.sprintf "%s (%s:%d)" text (Filename.basename (Location.file fence.at)) (Location.line fence.at)

let metres x = if x >= 1000. then Printf.sprintf "%.2f km" (x /. 1000.) else Printf.sprintf "%.1f m" x
let broken what fence by = Printf.sprintf "%s breaks %s by %s" what (named fence) (metres by)
let at place = Format.asprintf ", at %a" Position.pp place

(* {1 Plans} *)

type breach = { fence : fence; maneuver : string option; place : Position.t option; message : string }

let told (part : Plan_room.part) = if part.is_transit then "the way to " ^ part.leg else part.leg

(* On the way to its plan, a vehicle may come back from its present place. *)
let transit_rules fences (parts : Plan_room.part list) =
  let broken p = List.map fst (Fence.breaches_at fences.planned p) in
  match parts with
  | { is_transit = true; stretch; _ } :: _ -> broken stretch.from
  | _ -> []

let without fences numbers =
  make (List.filteri (fun i _ -> not (List.mem i numbers)) (Array.to_list fences.on_ground))

let rec on_ground fences parts =
  let breach (b : Fence.breach) =
    let part : Plan_room.part = List.nth parts b.stretch and fence = fences.on_ground.(b.rule) in
    { fence; maneuver = (if part.is_transit then None else Some part.leg); place = Some b.at;
      message = broken (told part) fence b.by ^ at b.at }
  in
  match transit_rules fences parts, List.partition (fun (p : Plan_room.part) -> p.is_transit) parts with
  | _ :: _ as broken, (transit, rest) -> (
      match on_ground (without fences broken) transit with
      | Some _ as found -> found
      | None -> on_ground fences rest)
  | [], _ ->
    Option.map breach (Fence.breach fences.planned (List.map (fun (p : Plan_room.part) -> p.stretch) parts))

let unknown what fence why = Printf.sprintf "%s may break %s: %s" what (named fence) why

let vertical fence (leg, (vertical : Plan_room.vertical)) =
  let over limit x =
    let by = x -. (limit -. fence.margin) in
    if by > 1e-9 then Some (broken leg fence by) else None
  in
  let message =
    match fence.rule, vertical with
    | Depth limit, Below_surface depth -> over limit depth
    | Depth _, At_altitude _ -> Some (unknown leg fence "its z is above the ground, and how deep that is is not known")
    | Height limit, (Above height | At_altitude height) -> over limit height
    | (Depth _ | Height _), Not_told -> Some (unknown leg fence "it has no depth or height")
    | Depth _, Above _ | Height _, Below_surface _ | (Inside _ | Outside _ | Distance _), _ -> None
  in
  Option.map (fun message -> { fence; maneuver = Some leg; place = None; message }) message

let of_plan fences ~from plan =
  let ups_and_downs () =
    let verticals = Plan_room.verticals plan in
    List.find_map (fun fence -> List.find_map (vertical fence) verticals) fences.all
  in
  match if Array.length fences.on_ground = 0 then None else on_ground fences (Plan_room.make ~from plan) with
  | Some breach -> Some breach
  | None -> ups_and_downs ()

(* {1 Plans side by side} *)

type near = { maneuver : string; other : string; place : Position.t; metres : float }

let limit fence = match fence.rule with Distance metres -> metres | Inside _ | Outside _ | Depth _ | Height _ -> 0.
let stretches parts = List.map (fun (part : Plan_room.part) -> part.stretch) parts

let near fences parts others =
  let meeting fence = Fence.nearest ~within:(limit fence) (stretches parts) (stretches others) in
  let told (m : Fence.meeting) =
    { maneuver = told (List.nth parts m.first); other = told (List.nth others m.second); place = m.place;
      metres = m.distance } in
  Option.map told (Option.bind (least_distance fences) meeting)

(* {1 Vehicles} *)

type sight = { place : Position.t; depth : float option; altitude : float option }

(* By number: areas as in [on_ground], then limits. *)
type beyond = (int * float) list

let nowhere = []
let leeway = 10.
let vertical_leeway = 2.
let areas fences = Array.length fences.on_ground
let numbered fences n = if n < areas fences then fences.on_ground.(n) else fences.limits.(n - areas fences)

(* A vehicle that dives, or floats, is not above the ground. *)
let height sight =
  match sight.altitude, sight.depth with
  | Some metres, _ -> Some metres
  | None, Some _ -> None
  | None, None -> Some sight.place.height

let over_limit sight fence =
  match fence.rule with
  | Depth limit -> Option.map (fun metres -> metres -. limit) sight.depth
  | Height limit -> Option.map (fun metres -> metres -. limit) (height sight)
  | Inside _ | Outside _ | Distance _ -> None

let beyond fences sight =
  let on_ground = if areas fences = 0 then [] else Fence.breaches_at fences.seen sight.place in
  let limit i fence =
    match over_limit sight fence with
    | Some by when by > Fence.tolerance -> Some (areas fences + i, by)
    | Some _ | None -> None
  in
  on_ground @ List.filter_map Fun.id (Array.to_list (Array.mapi limit fences.limits))

let of_vehicle fences ~since sight =
  let now = beyond fences sight in
  let allowed n = if n < areas fences then leeway else vertical_leeway in
  let is_new (n, by) = match List.assoc_opt n since with Some before -> by > before +. allowed n | None -> true in
  match List.find_opt is_new now with
  | Some (n, by) -> Error (broken "the vehicle" (numbered fences n) by ^ at sight.place)
  | None -> Ok (List.filter (fun (n, _) -> List.mem_assoc n now) since)

type under_way = { vehicle : string; plan : string; parts : Plan_room.part list }

let beside fences u others =
  let meeting fence =
    let nearest best other =
      let within = match best with Some (m, _) -> m.Fence.distance | None -> limit fence in
      match Fence.nearest ~within (stretches u.parts) (stretches other.parts) with
      | Some m -> Some (m, other)
      | None -> best
    in
    let message ((m : Fence.meeting), other) =
      Printf.sprintf "%s comes as near as %s to %s of plan '%s' of %s%s: it breaks %s" (told (List.nth u.parts m.first))
        (metres m.distance) (told (List.nth other.parts m.second)) other.plan other.vehicle (at m.place) (named fence)
    in
    Option.map message (List.fold_left nearest None (List.filter (fun other -> other.vehicle <> u.vehicle) others))
  in
  Option.bind (least_distance fences) meeting

let too_near fences vehicles =
  let pairs fence least =
    let near ((v, p) : string * Position.t) (w, q) =
      let metres_between = Wgs84.distance p q in
      if metres_between >= least -. Fence.tolerance then None
      else
        Some
          (v, w,
           Printf.sprintf "%s and %s are %s apart%s: they break %s by %s" v w (metres metres_between) (at p)
             (named fence)
             (metres (least -. metres_between)))
    in
    let rec each = function
      | [] -> []
      | vehicle :: others -> List.filter_map (near vehicle) others @ each others
    in
    each vehicles
  in
  match least_distance fences with
  | Some ({ rule = Distance least; _ } as fence) -> pairs fence least
  | Some _ | None -> []
