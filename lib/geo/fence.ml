open Rims

type side = Inside | Outside
type rule = { side : side; area : Area.t; margin : float }
type stretch = { from : Position.t; towards : Position.t; radius : float }
type breach = { rule : int; stretch : int; at : Position.t; by : float }

let tolerance = 5e-3

(* {1 Points and lines of a plane} *)

let away (ax, ay) (bx, by) = Float.hypot (ax -. bx) (ay -. by)
let between (ax, ay) (bx, by) share = (ax +. (share *. (bx -. ax)), ay +. (share *. (by -. ay)))

(* The share of the way from [a] to [b] at which it is nearest to [p]. *)
let nearest_share (px, py) (ax, ay) (bx, by) =
  let dx = bx -. ax and dy = by -. ay in
  let square = (dx *. dx) +. (dy *. dy) in
  if square = 0. then 0. else Float.max 0. (Float.min 1. ((((px -. ax) *. dx) +. ((py -. ay) *. dy)) /. square))

let from_line p a b = away p (between a b (nearest_share p a b))

(* The crossing of the line from [a] to [b] with that from [c] to [d], as a share of the former; not of parallel
   lines. *)
let crossing (ax, ay) (bx, by) (cx, cy) (dx, dy) =
  let ux = bx -. ax and uy = by -. ay and vx = dx -. cx and vy = dy -. cy in
  let turn = (ux *. vy) -. (uy *. vx) in
  if turn = 0. then None
  else
    let wx = cx -. ax and wy = cy -. ay in
    let share = ((wx *. vy) -. (wy *. vx)) /. turn and other = ((wx *. uy) -. (wy *. ux)) /. turn in
    if share >= 0. && share <= 1. && other >= 0. && other <= 1. then Some share else None

(* How near the line from [a] to [b] comes to that from [c] to [d], and at which share of the former. *)
let nearest_of_lines a b c d =
  match crossing a b c d with
  | Some share -> (0., share)
  | None ->
    let at_end best (distance, share) = if distance < fst best then (distance, share) else best in
    let of_point p = let share = nearest_share p a b in (away p (between a b share), share) in
    List.fold_left at_end (from_line a c d, 0.) [ (from_line b c d, 1.); of_point c; of_point d ]

(* {1 Areas on a plane} *)

type region = Disc of Plane.point * float | Walls of Rims.t

(* Metres from the rim, negative outside. *)
let depth region p =
  match region with
  | Disc (centre, radius) -> radius -. away p centre
  | Walls rims ->
    let from_rim = Rims.fold (fun d w -> Float.min d (from_line p w.low_end w.high_end)) infinity rims in
    if Rims.has rims p then from_rim else -.from_rim

(* Whether a point of the rim is less than [metres] from [p]. *)
let is_near_rim rims ((_, y) as p) metres =
  metres > 0.
  && Rims.fold_between (fun near w -> near || from_line p w.low_end w.high_end < metres) false rims ~low:(y -. metres)
    ~high:(y +. metres)

(* Metres by which a point of this depth breaks a rule that asks for [margin]. *)
let excess side margin depth = match side with Inside -> margin -. depth | Outside -> margin +. depth

(* {1 Rules} *)

type ready = { number : int; side : side; margin : float; region : region }

(* [extent]: how far from its origin, the [middle], the plane's areas reach. *)
type group = { plane : Plane.t; middle : Wgs84.vector; extent : float; rules : ready list }
type t = group list

let near = 10_000.

let region plane = function
  | Area.Circle { centre; radius } -> Disc (Plane.of_position plane centre, radius)
  | Shape shape ->
    let on_plane ring = Array.of_list (List.map (Plane.of_position plane) ring) in
    Walls (Rims.of_rings (List.map on_plane (Area.rings shape)))

(* Whether all of an area is near a group's middle. Most are so far that their first corner shows it. *)
let is_near group area =
  let within reach p =
    Wgs84.chord group.middle (Wgs84.vector p) <= reach && Wgs84.distance (Plane.origin group.plane) p <= reach in
  match area with
  | Area.Circle { centre; radius } -> within (near -. radius) centre
  | Shape shape -> List.for_all (List.for_all (within near)) (Area.rings shape)

(* A group of one area, in the plane of this. *)
let alone ({ side; area; margin } : rule) number =
  let plane, region, extent =
    match area with
    | Area.Circle { centre; radius } -> (Plane.around centre, Disc ((0., 0.), radius), radius)
    | Shape shape ->
      let plane, rings = Area.on_own_plane shape in
      let from_middle = Array.fold_left (fun most (x, y) -> Float.max most (Float.hypot x y)) in
      (plane, Walls (Rims.of_rings (Array.to_list rings)), Array.fold_left from_middle 0. rings)
  in
  { plane; middle = Wgs84.vector (Plane.origin plane); extent = (if extent <= near then near else extent);
    rules = [ { number; side; margin; region } ] }

let make rules =
  let add groups (number, ({ side; area; margin } as rule : rule)) =
    let join group = { group with rules = { number; side; margin; region = region group.plane area } :: group.rules } in
    let rec into = function
      | group :: others when group.extent <= near && is_near group area -> join group :: others
      | group :: others -> group :: into others
      | [] -> [ alone rule number ]
    in
    into groups
  in
  let in_order group = { group with rules = List.rev group.rules } in
  List.map in_order (List.fold_left add [] (List.mapi (fun i rule -> (i, rule)) rules))

let without_margins groups =
  let bare (rule : ready) = { rule with margin = 0. } in
  List.map (fun group -> { group with rules = List.map bare group.rules }) groups

(* For the roundings of a chord. *)
let slack = 1_000.

(* Whether no point at most [metres] from the place of [vector] can break a rule of [group]. *)
let is_out_of_sight group vector metres =
  let only_outside = List.for_all (fun rule -> rule.side = Outside) group.rules in
  let margin = List.fold_left (fun most (rule : ready) -> Float.max most rule.margin) 0. group.rules in
  only_outside && Wgs84.chord group.middle vector > group.extent +. margin +. metres +. slack

(* {1 One line against one rule} *)

type line = { a : Plane.point; b : Plane.point; line_box : box }

(* Shares of [line] between which it does not cross the rim. *)
let cuts rims line =
  let add cuts w =
    if are_near w.box line.line_box 0. then
      Option.fold (crossing line.a line.b w.low_end w.high_end) ~none:cuts ~some:(fun share -> share :: cuts)
    else cuts
  in
  let { low; high; _ } = line.line_box in
  List.sort_uniq Float.compare (0. :: 1. :: Rims.fold_between add [] rims ~low ~high)

let samples = 16

(* The worst of some points of [line]: the excess and the place. *)
let worst_sample side margin region rims line =
  let look best share =
    let p = between line.a line.b share in
    let by = excess side margin (depth region p) in
    if by > fst best then (by, p) else best
  in
  let rec pieces best = function
    | first :: (second :: _ as rest) ->
      let inside i = first +. ((second -. first) *. float_of_int i /. float_of_int samples) in
      pieces (List.fold_left look best (List.init samples (fun i -> inside i))) rest
    | [ last ] -> look best last
    | [] -> best
  in
  pieces (neg_infinity, line.a) (cuts rims line)

(* The nearest point of [line] to the rim, if some of it is nearer than [metres]. *)
let nearest_to_rim rims line metres =
  let look best w =
    if are_near w.box line.line_box metres then
      let distance, share = nearest_of_lines line.a line.b w.low_end w.high_end in
      match best with Some (least, _) when least <= distance -> best | Some _ | None -> Some (distance, share)
    else best
  in
  let low = line.line_box.low -. metres and high = line.line_box.high +. metres in
  match Rims.fold_between look None rims ~low ~high with
  | Some (distance, _) as found when distance < metres -> found
  | Some _ | None -> None

let worse (by, p) (by', p') = if by' > by then (by', p') else (by, p)

(* The worst of [line], which comes within the margin of the rim or crosses it. *)
let near_rim side margin region rims line (distance, share) =
  let nearest = (margin -. distance, between line.a line.b share) in
  let sampled = worst_sample side margin region rims line in
  if margin > tolerance then worse nearest sampled else sampled

(* [starts] is whether the line's beginning is inside, if that is known. The worst point of [line] if it breaks the
   rule, and whether its end is inside if that is known. *)
let against { side; margin; region; _ } ~radius ~starts line =
  let margin = margin +. radius in
  let unless_kept (by, p) = if by > tolerance then Some (by, p) else None in
  match region with
  | Disc (centre, r) ->
    let p =
      match side with
      | Inside -> if away line.a centre >= away line.b centre then line.a else line.b
      | Outside -> between line.a line.b (nearest_share centre line.a line.b)
    in
    (unless_kept (excess side margin (r -. away p centre), p), None)
  | Walls rims ->
    if side = Outside && not (are_near (Rims.box rims) line.line_box margin) then (None, Some false)
    else
      match nearest_to_rim rims line (margin +. tolerance) with
      | Some found -> (unless_kept (near_rim side margin region rims line found), None)
      | None ->
        let inside = match starts with Some inside -> inside | None -> Rims.has rims line.a in
        if inside = (side = Inside) then (None, Some inside)
        else (unless_kept (worst_sample side margin region rims line), Some inside)

(* {1 Ways} *)

(* Lines of some kilometres are straight on a plane. *)
let longest_piece = 10_000.

(* Most lines need no geodesic to be known as short: a hundredth of a degree is at most 1.2 km. *)
let surely_short (a : Position.t) (b : Position.t) =
  Float.abs (a.latitude -. b.latitude) < 0.04 && Float.abs (a.longitude -. b.longitude) < 0.04

let most_pieces = 10_000

let pieces s =
  if s.from == s.towards || surely_short s.from s.towards then [ s ]
  else
    let metres = Wgs84.distance s.from s.towards in
    if metres <= longest_piece then [ s ]
    else
      let n = min most_pieces (1 + int_of_float (metres /. longest_piece)) in
      let place i =
        if i = 0 then s.from
        else if i = n then s.towards
        else Wgs84.towards s.from s.towards (metres *. float_of_int i /. float_of_int n)
      in
      let rec from i a = if i > n then [] else let b = place i in { s with from = a; towards = b } :: from (i + 1) b in
      from 1 s.from

(* Pieces of [way] with the numbers of their stretches. *)
let cut way = List.concat (List.mapi (fun i s -> List.map (fun piece -> (i, piece)) (pieces s)) way)

(* Lines of a plane, each place looked up once where pieces follow one another. *)
let on_plane plane cut_way =
  let last = ref None in
  let point p =
    match !last with
    | Some (q, xy) when q == p || Position.equal q p -> xy
    | Some _ | None ->
      let xy = Plane.of_position plane p in
      last := Some (p, xy);
      xy
  in
  let line (_, piece) =
    let a = point piece.from in
    let b = if piece.towards == piece.from then a else point piece.towards in
    { a; b; line_box = box_of a b }
  in
  List.map line cut_way

(* Far from its areas a plane shows lines bent, and on the other side of the globe torn. *)
let is_far group radius line =
  let beyond = group.extent +. radius +. (5. *. longest_piece) in
  Float.hypot (fst line.a) (snd line.a) > beyond && Float.hypot (fst line.b) (snd line.b) > beyond

let against_far rule ~radius line =
  match rule.side with
  | Outside -> None
  | Inside -> Some (excess Inside (rule.margin +. radius) (depth rule.region line.a), line.a)

let of_rule group cut_way lines rule =
  let rec go starts cut_way lines =
    match cut_way, lines with
    | (stretch, piece) :: cut_way, line :: lines ->
      let radius = piece.radius in
      let found, ends =
        if is_far group (rule.margin +. radius) line then (against_far rule ~radius line, None)
        else against rule ~radius ~starts line
      in
      (match found, cut_way with
       | Some (by, p), _ -> Some (stretch, rule.number, by, p, group.plane)
       | None, (_, next) :: _ -> go (if next.from == piece.towards then ends else None) cut_way lines
       | None, [] -> None)
    | _, _ -> None
  in
  go None cut_way lines

let breach groups way =
  let cut_way = cut way in
  let earlier best found =
    match best, found with
    | Some (stretch, rule, _, _, _), Some (stretch', rule', _, _, _) when (stretch', rule') < (stretch, rule) -> found
    | None, _ -> found
    | Some _, _ -> best
  in
  let begins = List.map (fun (_, piece) -> (Wgs84.vector piece.from, longest_piece +. piece.radius)) cut_way in
  let of_group best group =
    if List.for_all (fun (from, metres) -> is_out_of_sight group from metres) begins then best
    else
      let lines = on_plane group.plane cut_way in
      List.fold_left (fun best rule -> earlier best (of_rule group cut_way lines rule)) best group.rules
  in
  let to_breach (stretch, rule, by, p, plane) = { rule; stretch; at = Plane.to_position plane p; by } in
  Option.map to_breach (List.fold_left of_group None groups)

(* Most places keep to a rule, which takes less than their depth to know. *)
let surely_keeps side margin p = function
  | Disc _ -> false
  | Walls rims -> Rims.has rims p = (side = Inside) && not (is_near_rim rims p margin)

let breaches_at groups p =
  let vector = Wgs84.vector p in
  let of_group group =
    if is_out_of_sight group vector 0. then []
    else
      let xy = Plane.of_position group.plane p in
      let of_rule { number; side; margin; region } =
        if surely_keeps side margin xy region then None
        else
          let by = excess side margin (depth region xy) in
          if by > tolerance then Some (number, by) else None
      in
      List.filter_map of_rule group.rules
  in
  List.sort compare (List.concat_map of_group groups)

(* {1 Ways beside each other} *)

type meeting = { first : int; second : int; place : Position.t; distance : float }

(* A plane goes along with the way, and shows the other side of the globe torn. *)
let is_torn line =
  Float.hypot (fst line.a) (snd line.a) > Plane.reach && Float.hypot (fst line.b) (snd line.b) > Plane.reach

let nearest ~within a b =
  let a = cut a and b = cut b in
  let on plane = List.combine b (on_plane plane b) in
  let closest best plane (i, piece) others =
    let line = List.hd (on_plane plane [ (i, piece) ]) in
    let look best ((j, other), other_line) =
      let apart = piece.radius +. other.radius in
      let limit = match best with Some m -> m.distance | None -> within -. tolerance in
      if is_torn other_line || not (are_near line.line_box other_line.line_box (limit +. apart)) then best
      else
        let metres, share = nearest_of_lines line.a line.b other_line.a other_line.b in
        let distance = Float.max 0. (metres -. apart) in
        if distance >= limit then best
        else
          let place = Plane.to_position plane (between line.a line.b share) in
          Some { first = i; second = j; place; distance }
    in
    List.fold_left look best others
  in
  let step (best, here) ((_, piece) as cut_piece) =
    let plane, others =
      match here with
      | Some (plane, others) when Wgs84.distance (Plane.origin plane) piece.from <= near -> (plane, others)
      | Some _ | None ->
        let plane = Plane.around piece.from in
        (plane, on plane)
    in
    (closest best plane cut_piece others, Some (plane, others))
  in
  fst (List.fold_left step (None, None) a)
