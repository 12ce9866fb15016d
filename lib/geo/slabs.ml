type side = { low : float * float; high : float * float }
type trapezoid = { left : side; right : side }
type t = { heights : float array; layers : trapezoid array array }

let at { low = x, y; high = x', y' } height =
  if height >= y' then x' else if height <= y then x else x +. ((x' -. x) *. (height -. y) /. (y' -. y))

let width t height = at t.right height -. at t.left height
let size_up_to t low height = (height -. low) *. (width t low +. width t height) /. 2.

let turned ~angle (x, y) =
  let x = float_of_int x and y = float_of_int y in
  let sine = sin angle and cosine = cos angle in
  (Float.round ((x *. cosine) +. (y *. sine)), Float.round ((y *. cosine) -. (x *. sine)))

let back ~angle (x, y) =
  let sine = sin angle and cosine = cos angle in
  ((x *. cosine) -. (y *. sine), (x *. sine) +. (y *. cosine))

let meetings a b y =
  let rec from i j =
    if i >= Array.length a || j >= Array.length b then []
    else
      let right_a = at a.(i).right y and right_b = at b.(j).right y in
      let others = if right_a < right_b then from (i + 1) j else from i (j + 1) in
      let common = Float.min right_a right_b -. Float.max (at a.(i).left y) (at b.(j).left y) in
      if common > 1. then (i, j) :: others else others
  in
  from 0 0

let sides_of ring =
  let n = Array.length ring in
  let side i p =
    let q = ring.((i + 1) mod n) in
    match Float.compare (snd p) (snd q) with
    | 0 -> None
    | order when order < 0 -> Some { low = p; high = q }
    | _ -> Some { low = q; high = p }
  in
  List.filter_map Fun.id (Array.to_list (Array.mapi side ring))

let rec in_pairs = function
  | left :: right :: rest -> { left; right } :: in_pairs rest
  | [ _ ] | [] -> []

let most_trapezoids = 300_000

exception Too_many

(* [started] are sides that begin at the layer's foot or above, in that order. *)
let layers heights sides =
  let count = ref 0 in
  let layer (active, started) i =
    let foot = heights.(i) in
    let middle = (foot +. heights.(i + 1)) /. 2. in
    let rec begun active = function
      | side :: rest when snd side.low <= foot -> begun (side :: active) rest
      | rest -> (active, rest)
    in
    let active, started = begun (List.filter (fun s -> snd s.high > foot) active) started in
    let active = List.sort (fun s t -> Float.compare (at s middle) (at t middle)) active in
    count := !count + (List.length active / 2);
    if !count > most_trapezoids then raise Too_many;
    ((active, started), Array.of_list (in_pairs active))
  in
  let state = ref ([], List.sort (fun s t -> Float.compare (snd s.low) (snd t.low)) sides) in
  Array.init (Int.max 0 (Array.length heights - 1)) (fun i ->
      let next, layer = layer !state i in
      state := next;
      layer)

let make ~angle rings =
  let rings = List.map (Array.map (turned ~angle)) rings in
  let heights = List.sort_uniq Float.compare (List.concat_map (fun r -> List.map snd (Array.to_list r)) rings) in
  let heights = Array.of_list heights in
  match layers heights (List.concat_map sides_of rings) with
  | layers -> Some { heights; layers }
  | exception Too_many -> None
