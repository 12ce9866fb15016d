let step ~most span =
  if not (span > 0.) then 1.
  else
    let least = span /. float_of_int most in
    let power = 10. ** Float.floor (Float.log10 least) in
    let fits = List.find_opt (fun m -> m *. power >= least *. 0.999) [ 1.; 2.; 5. ] in
    Option.value fits ~default:10. *. power

let of_clocks =
  [ 1.; 2.; 5.; 10.; 15.; 30.; 60.; 120.; 300.; 600.; 900.; 1800.; 3600.; 7200.; 10800.; 21600.; 43200.; 86400. ]

let time_step ~most span =
  match List.find_opt (fun s -> s *. float_of_int most >= span) of_clocks with
  | Some s -> s
  | None -> 86400. *. Float.ceil (span /. 86400. /. float_of_int most)

let multiples step ~from ~until =
  let first = Float.ceil ((from /. step) -. 1e-9) in
  let rec next i found =
    let x = (first +. float_of_int i) *. step in
    if i >= 1000 || x > until +. (step *. 1e-9) then List.rev found else next (i + 1) (x :: found)
  in
  next 0 []

let decimals step = max 0 (int_of_float (Float.ceil (-.Float.log10 step -. 1e-9)))

let spread ~least ~from ~until labels =
  let sorted = List.stable_sort (fun (a, _) (b, _) -> Float.compare a b) labels in
  (* Down from the first one, then up from the last. *)
  let down =
    let place (limit, found) (y, x) =
      let y = Float.max limit y in
      (y +. least, (y, x) :: found)
    in
    snd (List.fold_left place (from, []) sorted)
  in
  let place (limit, found) (y, x) =
    let y = Float.min limit y in
    (y -. least, (y, x) :: found)
  in
  snd (List.fold_left place (until, []) down)
