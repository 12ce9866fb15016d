type point = int * int
type ring = point array

let widest = 500_000_000

(* Above 0 if [r] is on the left of the way from [p] to [q]. *)
let orient (px, py) (qx, qy) (rx, ry) = ((qx - px) * (ry - py)) - ((qy - py) * (rx - px))

let cross (ax, ay) (bx, by) = (ax * by) - (ay * bx)
let dot (ax, ay) (bx, by) = (ax * bx) + (ay * by)
let minus (ax, ay) (bx, by) = (ax - bx, ay - by)
let compare_points ((ax, ay) : point) (bx, by) = if ax <> bx then Int.compare ax bx else Int.compare ay by
let next ring i = ring.(if i + 1 = Array.length ring then 0 else i + 1)

(* Whether the foot of [r] on the line through [a] and [b] is between these. *)
let beside a r b =
  let way = minus b a in
  let share = dot way (minus r a) in
  r <> a && r <> b && 0 < share && share < dot way way

let doubled_area ring =
  if ring = [||] then 0
  else
    let origin = ring.(0) in
    let sum = ref 0 in
    Array.iteri (fun i p -> sum := !sum + cross (minus p origin) (minus (next ring i) origin)) ring;
    !sum

(* {1 Sides} *)

(* From the lesser point to the greater; how often the region of the one and of the other lies more often around what
   is above it than around what is below. *)
type side = { p : point; q : point; a : int; b : int }

let bounds_overlap s t =
  let low (_, y) (_, y') = Int.min y y' and high (_, y) (_, y') = Int.max y y' in
  low s.p s.q <= high t.p t.q + 1 && low t.p t.q <= high s.p s.q + 1

let by_left s t = compare_points s.p t.p

(* [f i j] for the sides whose bounding boxes overlap, each pair once. [sides] are sorted by {!by_left}. *)
let pairs f sides =
  let n = Array.length sides in
  for i = 0 to n - 1 do
    let s = sides.(i) in
    let right = fst s.q in
    let j = ref (i + 1) in
    while !j < n && fst sides.(!j).p <= right + 1 do
      if bounds_overlap s sides.(!j) then f i !j;
      incr j
    done
  done

let sign = Int.compare

let exactly o _ _ = o = 0

(* Whether the line through [a] and [b] meets the unit square around a corner, which has [o] towards it. *)
let through_its_square o a b =
  let x, y = minus b a in
  2 * abs o <= abs x + abs y

type meeting =
  | Apart
  | Cut of point list * point list  (** points inside of the one side, and inside of the other, at their contact *)

(* A side is cut by each corner through whose unit square it goes: else rounding moved sides across corners again and
   again. In a larger square than that, sides that cross by a unit took each other's place again and again. *)
let meeting ~close s t =
  let o1 = orient s.p s.q t.p and o2 = orient s.p s.q t.q and o3 = orient t.p t.q s.p and o4 = orient t.p t.q s.q in
  let on o a r b = if close o a b && beside a r b then [ r ] else [] in
  let of_s = on o1 s.p t.p s.q @ on o2 s.p t.q s.q and of_t = on o3 t.p s.p t.q @ on o4 t.p s.q t.q in
  if of_s <> [] || of_t <> [] then Cut (of_s, of_t)
  else if sign o1 0 * sign o2 0 < 0 && sign o3 0 * sign o4 0 < 0 then begin
    let share = float_of_int o1 /. (float_of_int o1 -. float_of_int o2) in
    let between (a, b) = a + int_of_float (Float.round (share *. float_of_int (b - a))) in
    let r = (between (fst t.p, fst t.q), between (snd t.p, snd t.q)) in
    let inside s = if r <> s.p && r <> s.q then [ r ] else [] in
    Cut (inside s, inside t)
  end
  else Apart

(* {1 Simple rings} *)

type flaw = Few | Crossing of int * int

let flaw ring =
  let n = Array.length ring in
  if n < 3 || Array.for_all (fun r -> orient ring.(0) ring.(1) r = 0) ring then Some Few
  else
    let side i =
      let p = ring.(i) and q = next ring i in
      if compare_points p q < 0 then ({ p; q; a = 0; b = 0 }, i) else ({ p = q; q = p; a = 0; b = 0 }, i)
    in
    let numbered = Array.init n side in
    Array.sort (fun (s, _) (t, _) -> by_left s t) numbered;
    let sides = Array.map fst numbered in
    let found = ref None in
    let note i j =
      let i = snd numbered.(i) and j = snd numbered.(j) in
      let pair = (Int.min i j, Int.max i j) in
      match !found with
      | Some known when compare known pair <= 0 -> ()
      | Some _ | None -> found := Some pair
    in
    let neighbours i j =
      let i = snd numbered.(i) and j = snd numbered.(j) in
      (i + 1) mod n = j || (j + 1) mod n = i
    in
    let check i j =
      let s = sides.(i) and t = sides.(j) in
      let share_a_corner = s.p = t.p || s.p = t.q || s.q = t.p || s.q = t.q in
      if meeting ~close:exactly s t <> Apart || (share_a_corner && not (neighbours i j)) then note i j
    in
    pairs check sides;
    Option.map (fun (i, j) -> Crossing (i, j)) !found

let hull points =
  let half points =
    let add kept p =
      let rec back = function
        | b :: (a :: _ as rest) when orient a b p <= 0 -> back rest
        | kept -> p :: kept
      in
      back kept
    in
    match List.fold_left add [] points with [] -> [] | _ :: others -> List.rev others
  in
  let sorted = List.sort_uniq compare_points points in
  match sorted with
  | [] | [ _ ] -> Array.of_list sorted
  | _ -> Array.of_list (half sorted @ half (List.rev sorted))

(* {1 Sides that do not cross} *)

let most_sides = 100_000

exception Too_many

let merged sides =
  let table = Hashtbl.create (2 * List.length sides) in
  let add s =
    let a, b = Option.value (Hashtbl.find_opt table (s.p, s.q)) ~default:(0, 0) in
    Hashtbl.replace table (s.p, s.q) (a + s.a, b + s.b)
  in
  List.iter add sides;
  let keep (p, q) (a, b) kept = if a = 0 && b = 0 then kept else { p; q; a; b } :: kept in
  let left = Hashtbl.fold keep table [] in
  let sides = Array.of_list left in
  Array.sort (fun s t -> match by_left s t with 0 -> compare_points s.q t.q | order -> order) sides;
  sides

let pieces s cuts =
  let along = List.sort_uniq compare_points cuts in
  let piece p q = if compare_points p q < 0 then { s with p; q } else { p = q; q = p; a = -s.a; b = -s.b } in
  let rec go p = function [] -> if p = s.q then [] else [ piece p s.q ] | r :: rest -> piece p r :: go r rest in
  go s.p along

(* Crossings are rounded to the grid, which moves sides a little, so that others may cross: until none does. *)
let rec without_crossings rounds sides =
  if rounds = 0 || Array.length sides > most_sides then raise Too_many;
  let cuts = Array.make (Array.length sides) [] in
  let found = ref 0 in
  let cut i = function
    | [] -> ()
    | points ->
      incr found;
      if !found > most_sides then raise Too_many;
      cuts.(i) <- points @ cuts.(i)
  in
  let meet i j =
    match meeting ~close:through_its_square sides.(i) sides.(j) with
    | Apart -> ()
    | Cut (of_i, of_j) -> cut i of_i; cut j of_j
  in
  pairs meet sides;
  if !found = 0 then sides
  else
    let parts = List.concat (Array.to_list (Array.mapi (fun i s -> pieces s cuts.(i)) sides)) in
    without_crossings (rounds - 1) (merged parts)

(* {1 What is below a side} *)

(* Columns of equal width, each with the sides that reach into it. *)
let columns sides =
  let n = Array.length sides in
  let left = fst sides.(0).p in
  let right = Array.fold_left (fun most s -> Int.max most (fst s.q)) left sides in
  let count = Int.max 1 (Int.min n (4_000_000 / n)) in
  let width = Int.max 1 (((right - left) / count) + 1) in
  let column x = (x - left) / width in
  let within = Array.make (column right + 1) [] in
  Array.iter
    (fun s ->
       for c = column (fst s.p) to column (fst s.q) do
         within.(c) <- s :: within.(c)
       done)
    sides;
  fun x -> within.(column x)

let twice (x, y) = (2 * x, 2 * y)

(* How often each region lies around what is right below the middle of [s]. The line downwards leans a little to the
   left, so that it meets no corner and no side along its whole length. *)
let below column s =
  let (px, py) = s.p and (qx, qy) = s.q in
  let middle = (px + qx, py + qy) in
  let count (a, b) t =
    let p = twice t.p and q = twice t.q in
    if compare_points p middle < 0 && compare_points middle q < 0 && orient p q middle > 0 then (a + t.a, b + t.b)
    else (a, b)
  in
  List.fold_left count (0, 0) (column ((px + qx) asr 1))

(* The sides of the region [f a b], as ways that have it on their left. *)
let rim f sides =
  if sides = [||] then []
  else
    let column = columns sides in
    let has (a, b) = f (a <> 0) (b <> 0) in
    let way s =
      let a, b = below column s in
      match has (a, b), has (a + s.a, b + s.b) with
      | false, true -> Some (s.p, s.q)
      | true, false -> Some (s.q, s.p)
      | true, true | false, false -> None
    in
    List.filter_map way (Array.to_list sides)

(* {1 Rings} *)

(* How far clockwise [a] is from [back], as a class and then by {!cross}. *)
let clockwise back a b =
  let rank v =
    let c = cross back v in
    if c < 0 then 0 else if c > 0 then 2 else if dot back v < 0 then 1 else 3
  in
  match Int.compare (rank a) (rank b) with 0 -> Int.compare (cross a b) 0 | order -> order

(* The ways that leave a corner, and have not been gone. *)
let take ways u v =
  let left = List.filter (fun w -> w <> v) (Hashtbl.find ways u) in
  Hashtbl.replace ways u left

let next_corner ways u v =
  match Option.value (Hashtbl.find_opt ways v) ~default:[] with
  | [] -> None
  | first :: others ->
    let back = minus u v in
    let better best w = if clockwise back (minus w v) (minus best v) < 0 then w else best in
    Some (List.fold_left better first others)

(* A ring that meets itself in a corner is several. *)
let simple corners =
  let seen = Hashtbl.create 16 in
  let rec go rings stack = function
    | [] -> if stack = [] then rings else List.rev stack :: rings
    | p :: rest when Hashtbl.mem seen p ->
      let rec back loop = function
        | q :: stack when q <> p -> Hashtbl.remove seen q; back (q :: loop) stack
        | stack -> (loop, stack)
      in
      let loop, stack = back [] stack in
      go ((p :: loop) :: rings) stack rest
    | p :: rest -> Hashtbl.add seen p (); go rings (p :: stack) rest
  in
  go [] [] corners

let rec straightened corners =
  let ring = Array.of_list corners in
  let n = Array.length ring in
  let turns i = orient ring.((i + n - 1) mod n) ring.(i) (next ring i) <> 0 in
  let kept = List.filteri (fun i _ -> turns i) corners in
  if List.compare_lengths kept corners = 0 then ring else straightened kept

let length ring =
  let sum = ref 0. in
  Array.iteri (fun i (x, y) ->
      let x', y' = next ring i in
      sum := !sum +. Float.hypot (float_of_int (x' - x)) (float_of_int (y' - y))) ring;
  !sum

let sliver = 2.

let is_sliver ring = float_of_int (abs (doubled_area ring)) <= sliver *. length ring

let rings ways_list =
  let ways = Hashtbl.create (2 * List.length ways_list) in
  List.iter
    (fun (u, v) -> Hashtbl.replace ways u (v :: Option.value (Hashtbl.find_opt ways u) ~default:[]))
    ways_list;
  let rec follow start u v corners =
    take ways u v;
    if v = start && next_corner ways u v = None then corners
    else
      match next_corner ways u v with
      | None -> corners
      | Some w -> follow start v w (v :: corners)
  in
  let from (u, v) =
    if List.mem v (Option.value (Hashtbl.find_opt ways u) ~default:[]) then
      simple (List.rev (follow u u v [ u ]))
    else []
  in
  List.concat_map from ways_list
  |> List.map straightened
  |> List.filter (fun ring -> Array.length ring >= 3 && not (is_sliver ring))

let sides ~of_b ring =
  let side i p =
    let q = next ring i in
    let delta = if compare_points p q < 0 then 1 else -1 in
    let p, q = if delta > 0 then (p, q) else (q, p) in
    if of_b then { p; q; a = 0; b = delta } else { p; q; a = delta; b = 0 }
  in
  List.filter (fun s -> s.p <> s.q) (Array.to_list (Array.mapi side ring))

let most_rounds = 30

let combine f a b =
  let all = List.concat_map (sides ~of_b:false) a @ List.concat_map (sides ~of_b:true) b in
  match without_crossings most_rounds (merged all) with
  | exception Too_many -> None
  | sides -> Some (rings (rim f sides))
