open Summary

(* Times and charges; what a vehicle has not told is not drawn. *)
let known v = List.filter_map (fun s -> Option.map (fun battery -> (s.time, battery)) s.battery) v.samples

(* From and until which share, in whole steps. *)
let range summary =
  let batteries = List.concat_map (fun v -> List.map snd (known v)) summary.vehicles in
  let least = List.fold_left Float.min 1. batteries and most = List.fold_left Float.max 0. batteries in
  let least = Float.max 0. least and most = Float.min 1. (Float.max least most) in
  let span = Float.max 0.05 (most -. least) in
  let step = Scale.step ~most:5 span in
  let top = Float.min 1. (step *. Float.ceil ((most /. step) -. 1e-9)) in
  let bottom = Float.max 0. (step *. Float.floor ((Float.min least (top -. 0.05) /. step) +. 1e-9)) in
  (bottom, top, step)

let draw summary ~x ~y ~width ~height =
  let seconds = if summary.duration > 0. then summary.duration else 1. in
  let bottom, top, step = range summary in
  let labels_width =
    List.fold_left (fun w v -> Float.max w (Svg.width ~size:12. (Svg.fit 120. v.id))) 0. summary.vehicles +. 14.
  in
  let right = x +. width -. labels_width in
  let across time = x +. ((right -. x) *. time /. seconds) in
  let down charge = y +. (height *. (top -. charge) /. (top -. bottom)) in
  let level charge =
    let at = down charge in
    let percent = Printf.sprintf "%g%%" (Float.round (charge *. 1000.) /. 10.) in
    [ Svg.line ~name:"grid" (x, at) (right, at); Svg.text ~name:"axis" ~anchor:End (x -. 6., at +. 3.5) percent ]
  in
  let tick time =
    let at = across time in
    [ Svg.line ~name:"grid" (at, y) (at, y +. height);
      Svg.text ~name:"axis" ~anchor:(if time > 0. then Middle else Start) (at, y +. height +. 13.) (Phrase.time time) ]
  in
  let curve i v =
    let point (time, battery) = (across time, down battery) in
    Svg.polyline ~name:("track " ^ Style.vehicle i) (Tracks.thin (List.map point (known v)))
  in
  let wanted i v =
    match List.rev (known v) with
    | [] -> None
    | (time, battery) :: _ -> Some (down battery +. 4., (i, v, across time))
  in
  let wanted = List.filter_map Fun.id (List.mapi wanted summary.vehicles) in
  let label (at, (i, v, _)) = Svg.text ~name:("name " ^ Style.vehicle i) (right +. 8., at) (Svg.fit 120. v.id) in
  let names =
    if List.length wanted > 24 then []
    else List.map label (Scale.spread ~least:13. ~from:(y +. 4.) ~until:(y +. height +. 4.) wanted)
  in
  let time_step = Scale.time_step ~most:6 seconds in
  Svg.group ~name:"batteries"
    (List.concat_map level (Scale.multiples step ~from:bottom ~until:top)
     @ List.concat_map tick (Scale.multiples time_step ~from:0. ~until:seconds)
     @ [ Svg.rect ~name:"frame" ~x ~y ~width:(right -. x) ~height () ]
     @ List.mapi curve summary.vehicles @ names)
