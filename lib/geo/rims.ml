type box = { left : float; right : float; low : float; high : float }

let box_of (ax, ay) (bx, by) =
  { left = Float.min ax bx; right = Float.max ax bx; low = Float.min ay by; high = Float.max ay by }

let are_near a b metres =
  a.left -. b.right <= metres && b.left -. a.right <= metres && a.low -. b.high <= metres && b.low -. a.high <= metres

type wall = { low_end : Plane.point; high_end : Plane.point; box : box }

(* Bands of equal height from the bottom of the box, each with the walls that reach into it. *)
type t = { walls : wall array; box : box; height : float; bands : wall array array }

let walls_of_ring points =
  let n = Array.length points in
  Array.init n (fun i ->
      let a = points.(i) and b = points.((i + 1) mod n) in
      { low_end = a; high_end = b; box = box_of a b })

let wider a b =
  { left = Float.min a.left b.left; right = Float.max a.right b.right; low = Float.min a.low b.low;
    high = Float.max a.high b.high }

(* As many bands as let a wall be in four on the average. *)
let number_of_bands walls box =
  let n = float_of_int (Array.length walls) and whole = box.high -. box.low in
  let climbed = Array.fold_left (fun sum (w : wall) -> sum +. (w.box.high -. w.box.low)) 0. walls in
  if whole > 0. && climbed > 0. then Int.max 1 (int_of_float (Float.min n (3. *. n *. whole /. climbed))) else 1

(* The band of [y], the nearest one if [y] is in none. *)
let band rims y =
  let last = Array.length rims.bands - 1 in
  let n = (y -. rims.box.low) /. rims.height in
  if n >= float_of_int last then last else if n > 0. then int_of_float n else 0

let of_rings rings =
  let walls = Array.concat (List.map walls_of_ring rings) in
  let box = Array.fold_left (fun box (w : wall) -> wider box w.box) walls.(0).box walls in
  let count = number_of_bands walls box in
  let height = Float.max Float.min_float ((box.high -. box.low) /. float_of_int count) in
  let empty = { walls; box; height; bands = Array.make count [||] } in
  let within = Array.make count [] in
  let add (w : wall) =
    for i = band empty w.box.low to band empty w.box.high do
      within.(i) <- w :: within.(i)
    done
  in
  Array.iter add walls;
  { empty with bands = Array.map (fun walls -> Array.of_list (List.rev walls)) within }

let box rims = rims.box
let fold f start rims = Array.fold_left f start rims.walls

let fold_between f start rims ~low ~high =
  if high < rims.box.low || low > rims.box.high then start
  else begin
    let found = ref start in
    for i = band rims low to band rims high do
      found := Array.fold_left f !found rims.bands.(i)
    done;
    !found
  end

(* Only walls in the band of [y] can cross the line to the east; each is in that band once. *)
let has rims (x, y) =
  let crosses { low_end = ax, ay; high_end = bx, by; _ } =
    ay > y <> (by > y) && x < ax +. ((y -. ay) /. (by -. ay) *. (bx -. ax)) in
  fold_between (fun inside w -> if crosses w then not inside else inside) false rims ~low:y ~high:y
