(* [corners] of each rim in canonical order; [points] are the same in [plane]. *)
type shape = { corners : Position.t array array; plane : Plane.t; points : Plane.point array array }

type t = Circle of { centre : Position.t; radius : float } | Shape of shape

type error =
  | Radius of float
  | Width of float
  | Few_corners of int
  | Straight
  | Many_corners of int
  | Crossing of int * int
  | Hole of int * error
  | Hole_outside of int
  | Rims
  | Too_wide
  | Empty
  | Intricate
  | Parts of int
  | Pieces of int
  | Uncut of int

let ( let* ) = Result.bind

let circle centre radius =
  if Float.is_finite radius && radius >= 0. then Ok (Circle { centre; radius }) else Error (Radius radius)

(* {1 The grid} *)

let units_per_metre = 1000.
let units x = int_of_float (Float.round (x *. units_per_metre))
let on_grid (x, y) = (units x, units y)
let off_grid (x, y) = (float_of_int x /. units_per_metre, float_of_int y /. units_per_metre)

let compare_arrays compare a b =
  let n = Array.length a in
  match Int.compare n (Array.length b) with
  | 0 ->
    let rec from i = if i = n then 0 else match compare a.(i) b.(i) with 0 -> from (i + 1) | order -> order in
    from 0
  | order -> order

let area_of_ring ring =
  let n = Array.length ring in
  let sum = ref 0. in
  for i = 0 to n - 1 do
    let x, y = ring.(i) and x', y' = ring.((i + 1) mod n) in
    sum := !sum +. ((x *. y') -. (x' *. y))
  done;
  !sum /. 2.

let reversed ring =
  let n = Array.length ring in
  Array.init n (fun i -> ring.(n - 1 - i))

(* Corners with their places in a plane, which take most of the time. *)
let projected plane corners = Array.map (fun p -> (p, Plane.of_position plane p)) corners

let compare_corners (a, _) (b, _) = Position.compare a b

let from_first ring =
  let n = Array.length ring in
  let first = ref 0 in
  for i = 1 to n - 1 do
    if compare_corners ring.(i) ring.(!first) < 0 then first := i
  done;
  Array.init n (fun i -> ring.((i + !first) mod n))

(* Of rings of projected corners that turn the right way. *)
let shape plane rings =
  let rings = Array.of_list (List.map from_first rings) in
  Array.sort (compare_arrays compare_corners) rings;
  { corners = Array.map (Array.map fst) rings; plane; points = Array.map (Array.map snd) rings }

let rings shape = Array.to_list (Array.map Array.to_list shape.corners)

let on_own_plane shape = (shape.plane, shape.points)

(* {1 From corners} *)

let most_corners = 20_000
let most_of_path = 500

let plane_of positions = Option.to_result ~none:Too_wide (Plane.between positions)

let without_repetitions positions =
  let flat (p : Position.t) = { p with height = 0. } in
  let rec go = function
    | a :: (b :: _ as rest) when Position.equal a b -> go rest
    | a :: rest -> a :: go rest
    | [] -> []
  in
  match go (List.map flat positions) with
  | first :: (_ :: _ as rest) when Position.equal first (List.nth rest (List.length rest - 1)) ->
    first :: List.filteri (fun i _ -> i < List.length rest - 1) rest
  | positions -> positions

let simple corners =
  let n = Array.length corners in
  if n < 3 then Error (Few_corners n)
  else if n > most_corners then Error (Many_corners n)
  else
    let ring = Array.map (fun (_, point) -> on_grid point) corners in
    let same i = ring.(i) = ring.((i + 1) mod n) in
    match List.find_opt same (List.init n Fun.id) with
    | Some i -> Error (Crossing (i + 1, ((i + 1) mod n) + 1))
    | None -> (
        match Arrangement.flaw ring with
        | Some Few -> Error Straight
        | Some (Crossing (i, j)) -> Error (Crossing (i + 1, j + 1))
        | None -> Ok ring)

let turning ~left corners ring =
  if (Arrangement.doubled_area ring > 0) = left then corners else reversed corners

let left_turning ring = if Arrangement.doubled_area ring > 0 then ring else reversed ring

let rec fold_ok f i = function
  | [] -> Ok []
  | x :: rest ->
    let* y = f i x in
    let* ys = fold_ok f (i + 1) rest in
    Ok (y :: ys)

(* A hole is inside if the polygon, and each hole before it, stays as large as it was. *)
let hole_fits ring before i hole =
  match Arrangement.combine (fun a b -> b && not a) [ ring ] [ hole ], before with
  | None, _ -> Error Intricate
  | Some [], [] -> Ok ()
  | Some (_ :: _), _ -> Error (Hole_outside i)
  | Some [], _ :: _ -> (
      match Arrangement.combine ( && ) before [ hole ] with
      | None -> Error Intricate
      | Some [] -> Ok ()
      | Some (_ :: _) -> Error (Hole_outside i))

(* Holes of other programs leave strips where their corners are rounded, by 0.05 m with six digits of a degree. *)
let is_covered ~whole ~left ~length =
  let units_per_strip = 0.1 *. units_per_metre in
  left <= 4. *. length || (left <= 0.01 *. whole && left <= units_per_strip *. length)

let polygon ?(holes = []) corners =
  let corners = without_repetitions corners and holes = List.map without_repetitions holes in
  let all = List.concat (corners :: holes) in
  if List.length all > most_corners then Error (Many_corners (List.length all))
  else if List.length corners < 3 then Error (Few_corners (List.length corners))
  else
    let* plane = plane_of all in
    let project corners = projected plane (Array.of_list corners) in
    let corners = project corners and holes = List.map project holes in
    let* ring = simple corners in
    let hole i corners = Result.map_error (fun e -> Hole (i, e)) (simple corners) in
    let* hole_rings = fold_ok hole 1 holes in
    let fits before (i, hole) =
      let* before = before in
      let* () = hole_fits (left_turning ring) before i hole in
      Ok (hole :: before)
    in
    let numbered = List.mapi (fun i hole -> (i + 1, left_turning hole)) hole_rings in
    let* holes_inside = List.fold_left fits (Ok []) numbered in
    let doubled rings = List.fold_left (fun sum r -> sum +. float_of_int (Arrangement.doubled_area r)) 0. rings in
    let whole = doubled [ left_turning ring ] in
    let length = List.fold_left (fun sum r -> sum +. Arrangement.length r) 0. (ring :: holes_inside) in
    if holes_inside <> [] && is_covered ~whole ~left:(whole -. doubled holes_inside) ~length then Error Empty
    else Ok (Shape (shape plane (turning ~left:true corners ring :: List.map2 (turning ~left:false) holes hole_rings)))

(* Rims that cross, or turn the wrong way, enclose another area than the sum of theirs. *)
let well_formed rings =
  let doubled rings = List.fold_left (fun sum ring -> sum + Arrangement.doubled_area ring) 0 rings in
  match Arrangement.combine (fun a _ -> a) rings [] with
  | None -> false
  | Some united ->
    let length = List.fold_left (fun sum ring -> sum +. Arrangement.length ring) 0. rings in
    united <> [] && float_of_int (abs (doubled rings - doubled united)) <= 4. *. length

let of_rings rings =
  let all = List.concat rings in
  if List.length all > most_corners then Error (Many_corners (List.length all))
  else if rings = [] then Error Empty
  else if List.exists (fun ring -> List.compare_length_with ring 3 < 0) rings then Error (Few_corners 2)
  else
    let* plane = plane_of all in
    let corners = List.map (fun ring -> projected plane (Array.of_list ring)) rings in
    let on_plane = List.map (Array.map (fun (_, point) -> on_grid point)) corners in
    if well_formed on_plane then Ok (Shape (shape plane corners)) else Error Rims

(* {1 What an area is like} *)

let accuracy = 1e-3

let near_segment (x, y) (ax, ay) (bx, by) =
  let dx = bx -. ax and dy = by -. ay in
  let square = (dx *. dx) +. (dy *. dy) in
  let share = if square = 0. then 0. else (((x -. ax) *. dx) +. ((y -. ay) *. dy)) /. square in
  let share = Float.max 0. (Float.min 1. share) in
  Float.hypot (x -. ax -. (share *. dx)) (y -. ay -. (share *. dy)) <= accuracy

(* How often a line to the east crosses the rims decides, but for the rims themselves. *)
let has_point shape (x, y) =
  let inside = ref false and on_rim = ref false in
  let side ((_, ay) as a) ((_, by) as b) =
    if near_segment (x, y) a b then on_rim := true;
    if ay > y <> (by > y) then begin
      let ax = fst a and bx = fst b in
      if x < ax +. ((y -. ay) /. (by -. ay) *. (bx -. ax)) then inside := not !inside
    end
  in
  let rim ring = Array.iteri (fun i a -> side a ring.((i + 1) mod Array.length ring)) ring in
  Array.iter rim shape.points;
  !on_rim || !inside

let contains area position =
  match area with
  | Circle { centre; radius } -> Wgs84.distance centre position <= radius +. accuracy
  | Shape shape ->
    Wgs84.distance (Plane.origin shape.plane) position <= 2. *. Plane.reach
    && has_point shape (Plane.of_position shape.plane position)

let size = function
  | Circle { centre; radius } ->
    let earth = Plane.earth_radius (Plane.around centre) in
    4. *. Float.pi *. ((earth *. sin (radius /. (2. *. earth))) ** 2.)
  | Shape { points; _ } -> Array.fold_left (fun sum ring -> sum +. area_of_ring ring) 0. points

let centre = function
  | Circle { centre; _ } -> centre
  | Shape { points; plane; _ } ->
    let of_ring (x, y, whole) ring =
      let n = Array.length ring in
      let x = ref x and y = ref y in
      Array.iteri
        (fun i (ax, ay) ->
           let bx, by = ring.((i + 1) mod n) in
           let cross = (ax *. by) -. (bx *. ay) in
           x := !x +. ((ax +. bx) *. cross /. 6.);
           y := !y +. ((ay +. by) *. cross /. 6.))
        ring;
      (!x, !y, whole +. area_of_ring ring)
    in
    let x, y, whole = Array.fold_left of_ring (0., 0., 0.) points in
    Plane.to_position plane (x /. whole, y /. whole)

let corners_of_circle = 128

let circle_points (x, y) radius =
  Array.init corners_of_circle (fun i ->
      let angle = 2. *. Float.pi *. float_of_int i /. float_of_int corners_of_circle in
      (x +. (radius *. cos angle), y +. (radius *. sin angle)))

let corners = function
  | Shape { corners; _ } -> List.concat_map Array.to_list (Array.to_list corners)
  | Circle { centre; radius } ->
    Array.to_list (Array.map (Plane.to_position (Plane.around centre)) (circle_points (0., 0.) radius))

let from_minus_half_turn x = if x > 180. then x -. 360. else if x < -180. then x +. 360. else x

let bounds area =
  let middle = match area with Circle { centre; _ } -> centre | Shape { plane; _ } -> Plane.origin plane in
  let all = corners area in
  let least f = List.fold_left (fun m p -> Float.min m (f p)) infinity all in
  let most f = List.fold_left (fun m p -> Float.max m (f p)) neg_infinity all in
  let latitude (p : Position.t) = p.latitude in
  let east (p : Position.t) = from_minus_half_turn (p.longitude -. middle.longitude) in
  let pole latitude = contains area { Position.latitude; longitude = 0.; height = 0. } in
  let box (south, west) (north, east) : Position.t * Position.t =
    ( { latitude = south; longitude = west; height = 0. }, { latitude = north; longitude = east; height = 0. } )
  in
  if pole 90. then box (least latitude, -180.) (90., 180.)
  else if pole (-90.) then box (-90., -180.) (most latitude, 180.)
  else
    let at x = from_minus_half_turn (middle.longitude +. x) in
    box (least latitude, at (least east)) (most latitude, at (most east))

(* {1 Operations} *)

let regions plane = function
  | Circle { radius = 0.; _ } -> []
  | Circle { centre; radius } ->
    [ Array.map on_grid (circle_points (Plane.of_position plane centre) radius) ]
  | Shape { corners; _ } ->
    Array.to_list (Array.map (Array.map (fun p -> on_grid (Plane.of_position plane p))) corners)

let on_plane area =
  let* plane = plane_of (corners area) in
  match regions plane area with [] -> Error Empty | rings -> Ok (plane, rings)

let of_region plane rings =
  let corners ring = projected plane (Array.map (fun p -> Plane.to_position plane (off_grid p)) ring) in
  let count = List.fold_left (fun n ring -> n + Array.length ring) 0 rings in
  if rings = [] then Error Empty
  else if count > most_corners then Error (Many_corners count)
  else Ok (Shape (shape plane (List.map corners rings)))

let combined plane f a b =
  match Arrangement.combine f a b with None -> Error Intricate | Some rings -> of_region plane rings

let operate f a b =
  let* plane = plane_of (corners a @ corners b) in
  combined plane f (regions plane a) (regions plane b)

let union = operate ( || )
let intersection = operate ( && )
let difference = operate (fun a b -> a && not b)

let hull areas =
  let* plane = plane_of (List.concat_map corners areas) in
  let points = List.concat_map (fun area -> List.concat_map Array.to_list (regions plane area)) areas in
  let ring = Arrangement.hull points in
  if Array.length ring < 3 then Error Empty else of_region plane [ ring ]

let corners_of_arc = 32

(* The points at most [radius] from a side: half a circle around each end. *)
let capsule radius (ax, ay) (bx, by) =
  let course = atan2 (by -. ay) (bx -. ax) in
  let half = corners_of_arc / 2 in
  let around (x, y) from i =
    let angle = course +. from +. (Float.pi *. float_of_int i /. float_of_int half) in
    on_grid (x +. (radius *. cos angle), y +. (radius *. sin angle))
  in
  let arc p from = Array.init (half + 1) (around p from) in
  Array.append (arc (bx, by) (-.Float.pi /. 2.)) (arc (ax, ay) (Float.pi /. 2.))

let rec capsules radius = function
  | a :: (b :: _ as rest) -> if a = b then capsules radius rest else capsule radius a b :: capsules radius rest
  | [ _ ] | [] -> []

(* By halves: an inner part is dropped early. *)
let rec united = function
  | [] -> Some []
  | [ ring ] -> Some [ ring ]
  | rings ->
    let half = List.length rings / 2 in
    let part keep = united (List.filteri (fun i _ -> keep (i < half)) rings) in
    Option.bind (part Fun.id) (fun a -> Option.bind (part not) (fun b -> Arrangement.combine ( || ) a b))

let corridor path width =
  if not (Float.is_finite width && width > 0.) then Error (Width width)
  else
    match path with
    | [] -> Error (Few_corners 0)
    | _ when List.length path > most_of_path -> Error (Many_corners (List.length path))
    | path ->
      let* plane = plane_of path in
      if width > 2. *. Plane.reach then Error Too_wide
      else
        let radius = width /. 2. in
        match List.map (Plane.of_position plane) path with
        | first :: rest when List.for_all (( = ) first) rest ->
          combined plane (fun a _ -> a) [ Array.map on_grid (circle_points first radius) ] []
        | way -> (
            match united (capsules radius way) with None -> Error Intricate | Some rings -> of_region plane rings)

let closed ring = Array.to_list ring @ [ ring.(0) ]

let offset area metres =
  match area with
  | _ when not (Float.is_finite metres) -> Error (Radius metres)
  | Circle { centre; radius } -> if radius +. metres < 0. then Error Empty else circle centre (radius +. metres)
  | Shape { corners; plane; points } ->
    let count = Array.fold_left (fun n ring -> n + Array.length ring) 0 corners in
    if metres = 0. then Ok area
    else if Float.abs metres > Plane.reach then Error Too_wide
    else if count > most_of_path then Error (Many_corners count)
    else
      let rims = List.concat_map (fun ring -> capsules (Float.abs metres) (closed ring)) (Array.to_list points) in
      let f = if metres > 0. then ( || ) else fun a b -> a && not b in
      match united rims with
      | None -> Error Intricate
      | Some rims -> combined plane f (regions plane area) rims

let most_points = 10_000

let grid area metres =
  if not (Float.is_finite metres && metres > 0.) then Error (Width metres)
  else
    let plane = match area with Circle { centre; _ } -> Plane.around centre | Shape { plane; _ } -> plane in
    let all = List.map (Plane.of_position plane) (corners area) in
    let least f = List.fold_left (fun m p -> Float.min m (f p)) infinity all in
    let most f = List.fold_left (fun m p -> Float.max m (f p)) neg_infinity all in
    let west = least fst and south = least snd in
    let columns = Float.round ((most fst -. west) /. metres) and rows = Float.round ((most snd -. south) /. metres) in
    if columns *. rows > 20. *. float_of_int most_points then Error Intricate
    else begin
      let steps n = List.init (int_of_float n) (fun i -> metres *. (float_of_int i +. 0.5)) in
      let point y x = Plane.to_position plane (west +. x, south +. y) in
      let row y = List.filter (contains area) (List.map (point y) (steps columns)) in
      let found = List.concat_map row (steps rows) in
      if List.length found > most_points then Error Intricate else Ok found
    end

let most_parts = 100

let split area n =
  if n < 1 || n > most_parts then Error (Parts n)
  else if n = 1 then Ok [ area ]
  else
    let* plane, region = on_plane area in
    match Division.split region n with
    | Ok parts ->
      let* parts = fold_ok (fun _ part -> of_region plane part) 1 parts in
      let first part = List.hd (List.sort Position.compare (corners part)) in
      Ok (List.sort (fun a b -> Position.compare (first a) (first b)) parts)
    | Error (Division.Pieces n) -> Error (Pieces n)
    | Error No_cut -> Error (Uncut n)
    | Error Intricate -> Error Intricate

(* {1 Values} *)

let compare a b =
  match a, b with
  | Circle a, Circle b -> (
      match Position.compare a.centre b.centre with 0 -> Float.compare a.radius b.radius | order -> order)
  | Shape a, Shape b -> compare_arrays (compare_arrays Position.compare) a.corners b.corners
  | Circle _, Shape _ -> -1
  | Shape _, Circle _ -> 1

let equal a b = compare a b = 0

let hash = function
  | Circle { centre; radius } -> Hashtbl.hash (centre, radius)
  | Shape { corners; _ } -> Hashtbl.hash (Array.length corners, corners.(0).(0), corners.(0).(1), corners.(0).(2))

let shown_corners = 8

let pp ppf = function
  | Circle { centre; radius } -> Fmt.pf ppf "%a ^ %g m" Position.pp centre radius
  | Shape { corners = [| ring |]; _ } when Array.length ring <= shown_corners ->
    Fmt.pf ppf "polygon [%a]" Fmt.(array ~sep:(any ", ") Position.pp) ring
  | Shape { corners; points; _ } ->
    let polygons = Array.fold_left (fun n ring -> if area_of_ring ring > 0. then n + 1 else n) 0 points in
    let count = Array.fold_left (fun n ring -> n + Array.length ring) 0 corners in
    Fmt.pf ppf "area of %d polygon%s, %d corners" polygons (if polygons = 1 then "" else "s") count

let rec pp_error ppf = function
  | Radius x -> Fmt.pf ppf "a radius is 0 m or more, not %g" x
  | Width x -> Fmt.pf ppf "it takes more than 0 m, not %g" x
  | Few_corners n -> Fmt.pf ppf "a polygon has three corners or more that differ, not %d" n
  | Straight -> Fmt.pf ppf "the corners of a polygon are not on one line"
  | Many_corners n -> Fmt.pf ppf "an area has %d corners at most, not %d" most_corners n
  | Crossing (i, j) ->
    Fmt.pf ppf "a polygon does not cross itself: its sides from corner %d and from corner %d meet" i j
  | Hole (i, error) -> Fmt.pf ppf "hole %d: %a" i pp_error error
  | Hole_outside i -> Fmt.pf ppf "hole %d is not inside of the polygon, or meets another hole" i
  | Rims -> Fmt.string ppf "the rims of an area do not cross; they turn to the left, those of holes to the right"
  | Too_wide -> Fmt.pf ppf "an area reaches at most %g km from its middle" (Plane.reach /. 1000.)
  | Empty -> Fmt.string ppf "nothing is left: the area is empty"
  | Intricate -> Fmt.string ppf "the area is too intricate: too many points or sides would arise"
  | Parts n -> Fmt.pf ppf "an area is split into 1 to %d parts, not %d" most_parts n
  | Pieces n -> Fmt.pf ppf "an area of %d pieces has no connected parts of equal size: split each of them" n
  | Uncut n -> Fmt.pf ppf "no straight cuts were found that leave %d connected parts of equal size" n
