let both first second = if first <> 0 then first else second ()

let array compare xs ys =
  let rec from i = if i = Array.length xs then 0 else both (compare xs.(i) ys.(i)) (fun () -> from (i + 1)) in
  both (Int.compare (Array.length xs) (Array.length ys)) (fun () -> from 0)

let mix h h' = (h * 65599) + h'
