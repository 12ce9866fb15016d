open Slabs

type failure = Pieces of int | No_cut | Intricate

let ( let* ) = Option.bind

(* {1 What is connected below a line} *)

let root = Union_find.root

(* The piece that a trapezoid belongs to, of the region below its layer's foot and of the layer itself; how large that
   piece is below the foot. *)
type piece = { name : int; size : float }

(* [pieces heights layers] are those of each trapezoid, and how many there are in the end. *)
let pieces heights layers =
  let total = Array.fold_left (fun n layer -> n + Array.length layer) 0 layers in
  let parents = Array.init total Fun.id and sizes = Array.make total 0. in
  let unite i j =
    let i = root parents i and j = root parents j in
    if i <> j then begin
      parents.(i) <- j;
      sizes.(j) <- sizes.(j) +. sizes.(i)
    end
  in
  let first = ref 0 in
  let layer i trapezoids =
    let from = !first in
    let before = if i = 0 then [||] else layers.(i - 1) in
    let from_before = from - Array.length before in
    List.iter (fun (k, j) -> unite (from_before + k) (from + j)) (meetings before trapezoids heights.(i));
    let piece j _ =
      let name = root parents (from + j) in
      { name; size = sizes.(name) }
    in
    let found = Array.mapi piece trapezoids in
    Array.iteri
      (fun j t ->
         let name = root parents (from + j) in
         sizes.(name) <- sizes.(name) +. size_up_to t heights.(i) heights.(i + 1))
      trapezoids;
    first := from + Array.length trapezoids;
    found
  in
  let found = Array.mapi layer layers in
  let count = ref 0 in
  Array.iteri (fun i parent -> if i = parent then incr count) parents;
  (found, !count)

let reversed a =
  let n = Array.length a in
  Array.init n (fun i -> a.(n - 1 - i))

let upside_down slabs =
  let point (x, y) = (x, -.y) in
  let side s = { low = point s.high; high = point s.low } in
  let trapezoid t = { left = side t.left; right = side t.right } in
  { heights = Array.map Float.neg (reversed slabs.heights);
    layers = Array.map (Array.map trapezoid) (reversed slabs.layers) }

(* {1 Cuts} *)

(* The line at the height [at]; the part cut off lies below it as seen in the direction [angle]. *)
type cut = { angle : float; at : float; parts : int; length : float; wanted : float }

(* Whether all pieces but the one [without] hang together. In a layer, each trapezoid joins the piece below and the
   piece above it. *)
let hang_together below above without =
  let edges = ref [] in
  Array.iteri (fun j b -> if b.name <> without then edges := (b.name, above.(j).name) :: !edges) below;
  let alone = Array.for_all (fun a -> List.exists (fun (_, name) -> name = a.name) !edges) above in
  let rec reach lower upper =
    let more_upper = List.filter_map (fun (l, u) -> if List.mem l lower then Some u else None) !edges in
    let upper' = List.sort_uniq Int.compare (upper @ more_upper) in
    let more_lower = List.filter_map (fun (l, u) -> if List.mem u upper' then Some l else None) !edges in
    let lower' = List.sort_uniq Int.compare (lower @ more_lower) in
    if lower' = lower && upper' = upper then List.for_all (fun (_, u) -> List.mem u upper) !edges
    else reach lower' upper'
  in
  match !edges with
  | [] -> List.length (List.sort_uniq compare (Array.to_list (Array.map (fun a -> a.name) above))) = 1
  | (lower, upper) :: _ -> alone && reach [ lower ] [ upper ]

let rec bisect f low high times =
  if times = 0 then (low +. high) /. 2.
  else
    let middle = (low +. high) /. 2. in
    if f middle then bisect f middle high (times - 1) else bisect f low middle (times - 1)

(* The trapezoids of a layer, by the piece below to which they belong. *)
let by_piece trapezoids below =
  let add groups (piece, t) =
    match groups with
    | (first, members) :: groups when first.name = piece.name -> (first, t :: members) :: groups
    | groups -> (piece, [ t ]) :: groups
  in
  Array.to_list (Array.map2 (fun piece t -> (piece, t)) below trapezoids)
  |> List.stable_sort (fun (p, _) (q, _) -> Int.compare p.name q.name)
  |> List.fold_left add []

(* The cuts in one layer that cut off [k] of [n] parts below. *)
let cuts_of_layer ~angle ~whole ~n slabs i below above =
  let foot = slabs.heights.(i) and top = slabs.heights.(i + 1) in
  let of_piece ({ name; size }, members) =
    let up_to y = List.fold_left (fun sum t -> sum +. size_up_to t foot y) size members in
    let shares size = size /. whole *. float_of_int n in
    let first = Int.max 1 (int_of_float (Float.ceil (shares size))) in
    let last = Int.min (n - 1) (int_of_float (Float.floor (shares (up_to top)))) in
    if first > last || not (hang_together below above name) then []
    else
      List.init (last - first + 1) (fun d ->
          let parts = first + d in
          let wanted = whole *. float_of_int parts /. float_of_int n in
          let at = bisect (fun y -> up_to y < wanted) foot top 60 in
          { angle; at; parts; wanted; length = List.fold_left (fun sum t -> sum +. width t at) 0. members })
  in
  List.concat_map of_piece (by_piece slabs.layers.(i) below)

let cuts_below ~angle ~whole ~n slabs below above =
  let last = Array.length slabs.layers - 1 in
  List.concat
    (List.init (last + 1) (fun i -> cuts_of_layer ~angle ~whole ~n slabs i below.(i) above.(last - i)))

(* Below and above: the part above is below when seen the other way round. *)
let cuts_along ~whole ~n region angle =
  match Slabs.make ~angle region with
  | None -> None
  | Some slabs ->
    let turned = upside_down slabs in
    let below, count = pieces slabs.heights slabs.layers in
    let above, _ = pieces turned.heights turned.layers in
    let cuts =
      cuts_below ~angle ~whole ~n slabs below above
      @ List.map
        (fun cut -> { cut with angle = cut.angle +. Float.pi })
        (cuts_below ~angle ~whole ~n turned above below)
    in
    Some (count, cuts)

(* {1 Directions} *)

let side_directions ~most region =
  let of_ring ring =
    let n = Array.length ring in
    let side i (x, y) =
      let x', y' = ring.((i + 1) mod n) in
      let dx = float_of_int (x' - x) and dy = float_of_int (y' - y) in
      let angle = Float.rem (atan2 dy dx +. (2. *. Float.pi)) Float.pi in
      (-.Float.hypot dx dy, if angle > Float.pi -. 1e-3 then angle -. Float.pi else angle)
    in
    Array.to_list (Array.mapi side ring)
  in
  let longest = List.sort compare (List.concat_map of_ring region) in
  List.map snd (List.filteri (fun i _ -> i < most) longest)

let directions ~evenly ~sides region =
  let even = List.init evenly (fun i -> Float.pi *. float_of_int i /. float_of_int evenly) in
  List.sort_uniq Float.compare (even @ side_directions ~most:sides region)

(* Fewer for regions with many corners, so that the time is bounded. *)
let is_large region = List.fold_left (fun n ring -> n + Array.length ring) 0 region > 300

let few = directions ~evenly:12 ~sides:8

let many region =
  if is_large region then directions ~evenly:36 ~sides:20 region else directions ~evenly:180 ~sides:100 region

(* {1 Parts} *)

let size region = float_of_int (List.fold_left (fun sum ring -> sum + Arrangement.doubled_area ring) 0 region) /. 2.
let is_outer ring = Arrangement.doubled_area ring > 0

(* Whether [p], not on the rim of [ring], is inside. *)
let encloses ring (x, y) =
  let inside = ref false in
  Array.iteri
    (fun i (ax, ay) ->
       let bx, by = ring.((i + 1) mod Array.length ring) in
       if ay > y <> (by > y) then begin
         let turn = ((bx - ax) * (y - ay)) - ((by - ay) * (x - ax)) in
         if turn > 0 = (by > ay) then inside := not !inside
       end)
    ring;
  !inside

let connected_parts region =
  let outer, holes = List.partition is_outer region in
  let is_of ring hole =
    match List.find_opt (fun p -> not (Array.mem p ring)) (Array.to_list hole) with
    | Some p -> encloses ring p
    | None -> true
  in
  List.map (fun ring -> ring :: List.filter (is_of ring) holes) outer

let far = 300_000_000.

(* The part below the line. *)
let half_plane cut =
  let corner p =
    let x, y = Slabs.back ~angle:cut.angle p in
    (int_of_float (Float.round x), int_of_float (Float.round y))
  in
  Array.map corner [| (-.far, -.far); (far, -.far); (far, cut.at); (-.far, cut.at) |]

let without region part = Arrangement.combine (fun a b -> a && not b) region part

(* The connected part below the line that is nearest to the size wanted. *)
let below_line region cut =
  let* below = Arrangement.combine ( && ) region [ half_plane cut ] in
  let distance part = Float.abs (size part -. cut.wanted) in
  match List.sort (fun a b -> Float.compare (distance a) (distance b)) (connected_parts below) with
  | [] -> None
  | part :: _ -> Some part

let count_outer ?(above = 0.) region = List.length (List.filter (fun r -> is_outer r && size [ r ] > above) region)

(* A part hangs together by more than a neck if it does when the line is moved a little into it. *)
let wide_enough region part cut =
  let margin = 0.01 *. sqrt cut.wanted in
  let one region = count_outer ~above:(margin *. margin) region = 1 in
  let wider = { cut with at = cut.at +. margin } in
  let inner = Arrangement.combine ( && ) part [ half_plane { cut with at = cut.at -. margin } ] in
  let rest = Option.bind (below_line region wider) (without region) in
  Option.fold ~none:false ~some:one inner && Option.fold ~none:false ~some:one rest

(* The grid decides again whether the part has the wanted size, and both sides are connected: a cut may go right
   through corners. *)
let cut_off ~wide region cut =
  let* part = below_line region cut in
  let* rest = without region part in
  let exact = Float.abs (size part -. cut.wanted) <= (4. *. cut.length) +. (1e-8 *. cut.wanted) in
  if exact && count_outer rest = 1 && ((not wide) || wide_enough region part cut) then Some (cut.parts, part, rest)
  else None

(* The nearer to half of the parts, the better; then the shorter. *)
let by_preference n a b =
  let unevenness cut = abs ((2 * cut.parts) - n) in
  compare (unevenness a, a.length, a.angle, a.at) (unevenness b, b.length, b.angle, b.at)

let most_tried = 20

let best region n ~wide directions =
  let whole = size region in
  match List.filter_map (cuts_along ~whole ~n region) directions with
  | [] -> Error Intricate
  | (count, _) :: _ as found when List.for_all (fun (c, _) -> c > 1) found -> Error (Pieces count)
  | found ->
    let cuts = List.sort (by_preference n) (List.concat_map snd found) in
    let tried = List.filteri (fun i _ -> i < most_tried) cuts in
    Option.to_result ~none:No_cut (List.find_map (cut_off ~wide region) tried)

let rec first_cut region n = function
  | [] -> Error No_cut
  | (wide, directions) :: others -> (
      match best region n ~wide (directions region) with
      | Error No_cut -> first_cut region n others
      | found -> found)

let rec split region n =
  let ( let* ) = Result.bind in
  if n = 1 then Ok [ region ]
  else
    let* k, part, rest = first_cut region n [ (true, few); (true, many); (false, few); (false, many) ] in
    let* some = split part k in
    let* others = split rest (n - k) in
    Ok (some @ others)
