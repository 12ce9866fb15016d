open Mission_plan

let last_such is xs = List.find_opt is (List.rev xs)

let number name item =
  match List.assoc_opt name item.arguments with
  | Some (Number x) -> Some x
  | Some (Truth _ | Text _ | Place _ | Places _) | None -> None

let is_jump item = item.word = "jumpToItem"
let flat (p : Position.t) = Place { p with height = 0. }

(* {1 Jumps}

   [i] and [j] count all items, in their places; jumps count the numbered ones, from 1. *)

type layout = {
  all : item array;
  ordinals : int array;  (* how many numbered items there are before each *)
  places : int array;  (* of each numbered item *)
}

let layout m =
  let all = Array.of_list m.items in
  let places = List.filter (fun i -> is_numbered all.(i)) (List.init (Array.length all) Fun.id) in
  let count (n, found) item = ((if is_numbered item then n + 1 else n), n :: found) in
  let _, ordinals = List.fold_left count (0, []) m.items in
  { all; ordinals = Array.of_list (List.rev ordinals); places = Array.of_list places }

let target l i = l.places.(int_of_float (Option.value (number "item" l.all.(i)) ~default:1.) - 1)
let times l i = Option.value (number "times" l.all.(i)) ~default:1.

(* Whether jumps lead back, one within the other, and the height of each item is known: then its rounds can be told
   apart. *)
let is_regular l =
  let all = List.init (Array.length l.all) Fun.id in
  let jumps = List.filter (fun i -> is_jump l.all.(i)) all in
  let leads_back i = target l i < i in
  let nests i j = i >= j || target l j > i || target l j <= target l i in
  let climbs item = number "up" item <> None in
  jumps = []
  || List.for_all leads_back jumps
     && List.for_all (fun j -> List.for_all (fun i -> nests i j) jumps) jumps
     && not (Array.exists climbs l.all)

(* The height that is set before item [i], if one is. *)
let altitude_before l i =
  let rec from height k =
    if k = i then height
    else
      let set = match number "altitude" l.all.(k) with Some h -> Some h | None -> height in
      let height =
        match number "up" l.all.(k) with
        | Some up -> Some (Option.value set ~default:0. +. up)
        | None -> set
      in
      from height (k + 1)
  in
  from None 0

type writing = { next : int; latest_first : item list }

let write w item = { next = (if is_numbered item then w.next + 1 else w.next); latest_first = item :: w.latest_first }

(* The jump at [i], as often as [times], after the items back to its target. *)
let jump l i ~times w =
  let back = l.ordinals.(i) - l.ordinals.(target l i) in
  write w
    { word = "jumpToItem";
      arguments = [ ("item", Number (float_of_int (w.next - back))); ("times", Number times) ] }

let copy l ~first ~upto w =
  let add w i = if is_jump l.all.(i) then jump l i ~times:(times l i) w else write w l.all.(i) in
  List.fold_left add w (List.init (upto - first) (fun k -> first + k))

(* Another round from the target of the jump at [i] on, and as many after it as there are. *)
let rounds l i left w =
  let first = target l i in
  let set = Option.value ~default:0. in
  let before = set (altitude_before l first) in
  let w =
    if before = set (altitude_before l i) then w
    else write w { word = "altitude"; arguments = [ ("altitude", Number before) ] }
  in
  let w = copy l ~first ~upto:i w in
  if left = 1. then w else jump l i ~times:(if left < 0. then -1. else left -. 1.) w

(* The items after item [i]. A jump to [i] or before it is under way, and leads to items that were left out. *)
let after l i taken w =
  let add w k =
    if not (is_jump l.all.(k)) then write w l.all.(k)
    else if target l k > i then jump l k ~times:(times l k) w
    else
      let taken = Option.value (List.assoc_opt l.ordinals.(k) taken) ~default:0. in
      let left = if times l k < 0. then -1. else times l k -. taken in
      if left = 0. then w else rounds l k left w
  in
  List.fold_left add w (List.init (Array.length l.all - i - 1) (fun k -> i + 1 + k))

(* {1 The item that was cut} *)

(* [way] is the altitude and the speed in force. *)
let go way place = { word = "goPos"; arguments = ("position", flat place) :: way }

let kept names item = List.filter (fun (name, _) -> List.mem name names) item.arguments

(* [item] at its place, wherever the vehicle comes from. *)
let at_its_place way place item =
  let to_place word names way =
    { word; arguments = (("position", flat place) :: kept names item) @ way } in
  match item.word with
  | "landingPoint" -> to_place "landingPoint" [] []
  | "returnHomeAndLand" -> { item with arguments = way }
  | "moveAndLoiter" | "loiterPos" | "returnHomeAndLoiter" ->
    to_place "loiterPos" [ "duration"; "turns"; "radius" ] way
  | "loiterTurns" | "loiterTime" -> to_place item.word [ "duration"; "turns"; "radius" ] way
  | _ -> go way place

let on_the_way way item (leg : Mission_plan.leg) (cut : Way.cut) =
  let rest = Way.drop cut.passed leg.waypoints in
  let items =
    match item.word with
    | "surveyArea" -> List.map (go way) rest
    | _ -> List.map (fun place -> at_its_place way place item) rest
  in
  let carries_way = not (List.mem item.word [ "landingPoint"; "returnHomeAndLand" ]) in
  match rest with
  | next :: _ when carries_way && Way.is_there cut.place next -> (None, items)
  | _ -> (Some (go way cut.place), items)

(* Vehicles fly whole turns, and whole seconds. *)
let left_of share (name, argument) =
  match name, argument with
  | ("turns" | "duration"), Number all ->
    (name, Number (Float.min all (Float.max 1. (Float.ceil ((all *. share) -. 1e-6)))))
  | _ -> (name, argument)

let staying way item (leg : Mission_plan.leg) (cut : Way.cut) seconds =
  let share = 1. -. (seconds /. leg.dwell) in
  let go = go way cut.place in
  if share *. leg.dwell < 1e-6 then (Some go, [])
  else
    let rest =
      if item.word = "delay" then item else at_its_place way cut.place item in
    let rest = { rest with arguments = List.map (left_of share) rest.arguments } in
    ((if item.word = "delay" then Some go else None), [ rest ])

(* {1 What holds at the cut} *)

(* [before] is the items that were carried out, the latest first, each with the number of its step. *)

let is_word words (item, _) = List.mem item.word words
let latest words before = List.map fst (Option.to_list (List.find_opt (is_word words) before))

(* Several photos begin again if some may be missing. *)
let photos before seconds_since =
  match List.find_opt (is_word [ "captureSeveralPhotos"; "captureUntilStop"; "stopCapturing" ]) before with
  | Some (({ word = "captureSeveralPhotos"; _ } as item), step) ->
    let number name = Option.value (number name item) ~default:1. in
    if seconds_since step < number "count" *. number "interval" then [ item ] else []
  | Some (({ word = "captureUntilStop"; _ } as item), _) -> [ item ]
  | Some _ | None -> []

(* A home that is set without a place is where the vehicle is then. *)
let home l executed =
  let last here places = match List.rev places with place :: _ -> Some place | [] -> here in
  let add (here, found) (step : step) =
    let item = l.all.(l.places.(step.index)) in
    let found =
      match item.word, item.arguments, here with
      | "home", [], Some here -> [ { item with arguments = [ ("position", flat here) ] } ]
      | "home", _, _ -> [ item ]
      | _, _, _ -> found
    in
    (last here step.leg.waypoints, found)
  in
  snd (List.fold_left add (None, []) executed)

(* The altitude and the speed in force, as arguments. *)
let way l i (leg : Mission_plan.leg) executed =
  let altitude = Option.map (fun h -> ("altitude", Number h)) (altitude_before l (i + 1)) in
  let sets_speed item = number "speed" item <> None in
  let speed = if List.exists sets_speed executed then Some ("speed", Number leg.speed) else None in
  Option.to_list altitude @ Option.to_list speed

let rest l steps (cut : Way.cut) seconds_since =
  let step = List.nth steps cut.leg in
  let i = l.places.(step.index) in
  let item = l.all.(i) and item_of step = l.all.(l.places.(step.index)) in
  let executed = List.filteri (fun k _ -> k < cut.leg) steps in
  let before = List.rev (List.mapi (fun k step -> (item_of step, k)) executed) in
  let way = way l i step.leg (item :: List.map fst before) in
  let first, items =
    match cut.stayed with
    | Some seconds -> staying way item step.leg cut seconds
    | None -> on_the_way way item step.leg cut
  in
  let photos = photos before seconds_since in
  let first = if first = None && photos <> [] then Some (go way cut.place) else first in
  let arms = List.filteri (fun k item -> k < i && item.word = "arm") (Array.to_list l.all) in
  let beginning =
    Option.to_list (last_such (fun _ -> true) arms)
    @ latest [ "takeOff"; "takeOffWithYaw" ] before
    @ home l executed @ Option.to_list first @ photos @ items
  in
  let written = List.fold_left write { next = 1; latest_first = [] } beginning in
  List.rev (after l i step.taken written).latest_first

let from_share x ~from m =
  let l = layout m in
  if not (is_regular l) then m
  else
    let steps = steps ~from ~speed:1. m in
    let leg ({ leg = { waypoints; speed; dwell; _ }; _ } : step) = { Way.waypoints; speed; dwell } in
    let legs = List.rev (List.rev_map leg steps) in
    match Way.cut x legs with
    | None -> m
    | Some cut ->
      let done_in_all = Float.min 1. x *. Way.seconds legs in
      let seconds_since k = done_in_all -. Way.seconds (List.filteri (fun j _ -> j <= k) legs) in
      { m with items = rest l steps cut seconds_since }
