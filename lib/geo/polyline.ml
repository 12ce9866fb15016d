(* From [p] to the straight line between [a] and [b], which is below the ground by less than [p] is beside it wherever
   that matters: by 0.5 m in 5 km. *)
let beside a b p =
  let ab = Wgs84.straight a b and ap = Wgs84.straight a p and bp = Wgs84.straight b p in
  let along = ((ap *. ap) +. (ab *. ab) -. (bp *. bp)) /. (2. *. ab) in
  if ab = 0. || along <= 0. then ap
  else if along >= ab then bp
  else sqrt (Float.max 0. ((ap *. ap) -. (along *. along)))

let most_at_once = 1000

let simplified ~tolerance ps =
  let places = Array.of_list ps in
  let last = Array.length places - 1 in
  let ground = Array.map (fun (p : Position.t) -> Wgs84.cartesian { p with height = 0. }) places in
  let stays = Array.init (last + 1) (fun i -> i mod most_at_once = 0 || i = last) in
  let farthest from until =
    let most = ref (from, tolerance) in
    for i = from + 1 to until - 1 do
      let metres = beside ground.(from) ground.(until) ground.(i) in
      if metres > snd !most then most := (i, metres)
    done;
    fst !most
  in
  let rec look = function
    | [] -> ()
    | (from, until) :: others ->
      let i = farthest from until in
      if i = from then look others
      else begin
        stays.(i) <- true;
        look ((from, i) :: (i, until) :: others)
      end
  in
  look (List.init ((last + most_at_once - 1) / most_at_once) (fun k ->
      (k * most_at_once, min last ((k + 1) * most_at_once))));
  List.filteri (fun i _ -> stays.(i)) ps
