open Dolphin_geo

let at latitude longitude : Position.t = { latitude; longitude; height = 0. }
let area = function Ok area -> area | Error e -> Alcotest.failf "%a" Area.pp_error e
let origin = at 41.18 (-8.7)
let place (east, north) = Wgs84.displace origin ~north ~east
let polygon ?holes corners = Area.polygon ?holes:(Option.map (List.map (List.map place)) holes) (List.map place corners)
let square x y side = [ (x, y); (x +. side, y); (x +. side, y +. side); (x, y +. side) ]

let length way =
  let add (sum, before) p = (sum +. Wgs84.distance before p, p) in
  match way with [] -> 0. | first :: rest -> fst (List.fold_left add (0., first) rest)

let rim = function
  | Area.Circle { radius; _ } -> 2. *. Float.pi *. radius
  | Shape s -> List.fold_left (fun sum ring -> sum +. length (ring @ [ List.hd ring ])) 0. (Area.rings s)

(* {1 On a plane} *)

let rec segments = function a :: (b :: _ as rest) -> (a, b) :: segments rest | [ _ ] | [] -> []

let distance_to (x, y) ((ax, ay), (bx, by)) =
  let dx = bx -. ax and dy = by -. ay in
  let square = (dx *. dx) +. (dy *. dy) in
  let share = if square = 0. then 0. else (((x -. ax) *. dx) +. ((y -. ay) *. dy)) /. square in
  let share = Float.max 0. (Float.min 1. share) in
  Float.hypot (x -. ax -. (share *. dx)) (y -. ay -. (share *. dy))

(* {1 Random polygons} *)

let star =
  let open QCheck2.Gen in
  let corner n i (share, radius) =
    let angle = 2. *. Float.pi *. (float_of_int i +. (0.8 *. share)) /. float_of_int n in
    (radius *. cos angle, radius *. sin angle)
  in
  let of_list drawn = List.mapi (corner (List.length drawn)) drawn in
  map of_list (list_size (int_range 4 14) (pair (float_bound_inclusive 1.) (float_range 20. 100.)))

let steps =
  let open QCheck2.Gen in
  let top i h = [ (20. *. float_of_int (i + 1), h); (20. *. float_of_int i, h) ] in
  let tops heights = List.concat (List.rev (List.mapi top heights)) in
  let of_list heights =
    let n = List.length heights in
    (0., 0.) :: (20. *. float_of_int n, 0.) :: tops heights
  in
  map of_list (list_size (int_range 1 7) (map (fun i -> float_of_int (20 * i)) (int_range 1 5)))

let corners = QCheck2.Gen.oneof [ star; steps ]

let pp_corners = Fmt.(Dump.list (Dump.pair float float))
