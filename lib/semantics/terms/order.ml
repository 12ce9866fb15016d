let both first second = if first <> 0 then first else second ()

let array compare xs ys =
  let rec from i = if i = Array.length xs then 0 else both (compare xs.(i) ys.(i)) (fun () -> from (i + 1)) in
  both (Int.compare (Array.length xs) (Array.length ys)) (fun () -> from 0)

let rec list compare xs ys =
  if xs == ys then 0
  else
    match xs, ys with
    | [], [] -> 0
    | [], _ :: _ -> -1
    | _ :: _, [] -> 1
    | x :: xs, y :: ys -> both (compare x y) (fun () -> list compare xs ys)

(* Each bit of the result depends on each bit of [h] and [h']. *)
let mix h h' =
  let h = (h * 0x1E3779B97F4A7C15) + h' in
  let h = (h lxor (h lsr 31)) * 0x3F58476D1CE4E5B9 in
  h lxor (h lsr 29)
