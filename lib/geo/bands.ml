open Slabs

type part = {
  height : float;
  left : float;
  right : float;
  gates : (int * float * float) list;
  upper : int list;
  lower : int list;
}

(* A layer, or a piece of one, that is in one band. *)
type slice = { foot : float; top : float; band : int; trapezoids : trapezoid array }

let slices { heights; layers } ~count ~height =
  let bottom = heights.(0) in
  let edge band = bottom +. (height *. float_of_int band) in
  let rec of_layer band foot top trapezoids =
    if band < count - 1 && edge (band + 1) <= foot then of_layer (band + 1) foot top trapezoids
    else if band = count - 1 || edge (band + 1) >= top then [ { foot; top; band; trapezoids } ]
    else
      { foot; top = edge (band + 1); band; trapezoids } :: of_layer (band + 1) (edge (band + 1)) top trapezoids
  in
  let layer i trapezoids =
    let first = Int.max 0 (Int.min (count - 1) (int_of_float ((heights.(i) -. bottom) /. height) - 1)) in
    of_layer first heights.(i) heights.(i + 1) trapezoids
  in
  Array.of_list (List.concat (Array.to_list (Array.mapi layer layers)))

(* [f below above y] for each two trapezoids, by their numbers, that meet at the height [y], with the slices' own. *)
let iter_meetings f slices firsts =
  for i = 1 to Array.length slices - 1 do
    let a = slices.(i - 1) and b = slices.(i) in
    let pair (j, k) = f (a, j) (b, k) (firsts.(i - 1) + j) (firsts.(i) + k) in
    List.iter pair (meetings a.trapezoids b.trapezoids b.foot)
  done

let add n ns = if List.mem n ns then ns else n :: ns
let above (n, from, until) part = { part with gates = (n, from, until) :: part.gates; upper = add n part.upper }
let below (n, from, until) part = { part with gates = (n, from, until) :: part.gates; lower = add n part.lower }

(* The number of the part that each trapezoid belongs to, and how many parts there are. *)
let numbered slices firsts total =
  let parents = Array.init total Fun.id in
  let join (a, _) (b, _) i j =
    if a.band = b.band then parents.(Union_find.root parents i) <- Union_find.root parents j
  in
  iter_meetings join slices firsts;
  let numbers = Array.make total (-1) and known = ref 0 in
  let number i =
    let r = Union_find.root parents i in
    if numbers.(r) < 0 then begin
      numbers.(r) <- !known;
      incr known
    end;
    numbers.(r)
  in
  let of_all = Array.init total number in
  (of_all, !known)

let slack = 1e-3

let make slabs ~most =
  let bottom = slabs.heights.(0) and top = slabs.heights.(Array.length slabs.heights - 1) in
  let count = Int.max 1 (int_of_float (Float.ceil (((top -. bottom) /. most) -. slack))) in
  let height = (top -. bottom) /. float_of_int count in
  let slices = slices slabs ~count ~height in
  let total = ref 0 in
  let first slice =
    total := !total + Array.length slice.trapezoids;
    !total - Array.length slice.trapezoids
  in
  let firsts = Array.map first slices in
  let numbers, known = numbered slices firsts !total in
  let none = { height = 0.; left = infinity; right = neg_infinity; gates = []; upper = []; lower = [] } in
  let parts = Array.make known none in
  let widen slice first j (t : trapezoid) =
    let n = numbers.(first + j) in
    let left = Float.min (at t.left slice.foot) (at t.left slice.top) in
    let right = Float.max (at t.right slice.foot) (at t.right slice.top) in
    let part = parts.(n) in
    parts.(n) <- { part with height = bottom +. (height *. (float_of_int slice.band +. 0.5));
                             left = Float.min part.left left; right = Float.max part.right right }
  in
  Array.iteri (fun i slice -> Array.iteri (widen slice firsts.(i)) slice.trapezoids) slices;
  let gate (a, j) (b, k) i i' =
    if a.band <> b.band then begin
      let t : trapezoid = a.trapezoids.(j) and u : trapezoid = b.trapezoids.(k) and y = b.foot in
      let from = Float.max (at t.left y) (at u.left y) and until = Float.min (at t.right y) (at u.right y) in
      let i = numbers.(i) and i' = numbers.(i') in
      parts.(i) <- above (i', from, until) parts.(i);
      parts.(i') <- below (i, from, until) parts.(i')
    end
  in
  iter_meetings gate slices firsts;
  parts
