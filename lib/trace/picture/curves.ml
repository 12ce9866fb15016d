open Summary

type quantity = {
  known : vehicle -> (float * float) list;
  range : t -> float * float * float;
  label : float -> string;
}

(* {1 Batteries} *)

(* Times and charges; values that a vehicle has not reported are not drawn. *)
let charges v = List.filter_map (fun s -> Option.map (fun battery -> (s.time, battery)) s.battery) v.samples

let all known summary = List.concat_map (fun v -> List.map snd (known v)) summary.vehicles

(* From and until which share, in whole steps. *)
let range_of_charges summary =
  let batteries = all charges summary in
  let least = List.fold_left Float.min 1. batteries and most = List.fold_left Float.max 0. batteries in
  let least = Float.max 0. least and most = Float.min 1. (Float.max least most) in
  let span = Float.max 0.05 (most -. least) in
  let step = Scale.step ~most:5 span in
  let top = Float.min 1. (step *. Float.ceil ((most /. step) -. 1e-9)) in
  let bottom = Float.max 0. (step *. Float.floor ((Float.min least (top -. 0.05) /. step) +. 1e-9)) in
  (bottom, top, step)

let percent share = Printf.sprintf "%g%%" (Float.round (share *. 1000.) /. 10.)
let batteries = { known = charges; range = range_of_charges; label = percent }

(* {1 Heights} *)

let altitudes v = List.map (fun s -> (s.time, s.position.height)) v.samples

let least_span = 2.

let range_of_heights summary =
  let found = all altitudes summary in
  let least = List.fold_left Float.min 0. found and most = List.fold_left Float.max 0. found in
  let span = Float.max least_span (most -. least) in
  let step = Scale.step ~most:5 span in
  let bottom = step *. Float.floor ((least /. step) +. 1e-9) and top = step *. Float.ceil ((most /. step) -. 1e-9) in
  (bottom, (if top > bottom then top else bottom +. step), step)

let heights = { known = altitudes; range = range_of_heights; label = Printf.sprintf "%g m" }

(* Below that it is the sea, not the vehicle, that goes up and down. *)
let has_heights summary = List.exists (fun height -> Float.abs height >= 0.5) (all altitudes summary)

(* {1 Drawing} *)

let draw { known; range; label = text_of } summary ~x ~y ~width ~height =
  let seconds = if summary.duration > 0. then summary.duration else 1. in
  let bottom, top, step = range summary in
  let labels_width =
    List.fold_left (fun w v -> Float.max w (Svg.width ~size:12. (Svg.fit 120. v.id))) 0. summary.vehicles +. 14.
  in
  let right = x +. width -. labels_width in
  let across time = x +. ((right -. x) *. time /. seconds) in
  let down value = y +. (height *. (top -. value) /. (top -. bottom)) in
  let level value =
    let at = down value in
    let text = Svg.text ~name:"axis" ~anchor:End (x -. 6., at +. 3.5) (text_of value) in
    [ Svg.line ~name:"grid" (x, at) (right, at); text ]
  in
  let tick time =
    let at = across time in
    [ Svg.line ~name:"grid" (at, y) (at, y +. height);
      Svg.text ~name:"axis" ~anchor:(if time > 0. then Middle else Start) (at, y +. height +. 13.) (Phrase.time time) ]
  in
  let curve i v =
    let point (time, x) = (across time, down x) in
    Style.group i [ Svg.polyline ~name:("track " ^ Style.vehicle i) (Tracks.thin (List.map point (known v))) ]
  in
  let wanted i v =
    match List.rev (known v) with
    | [] -> None
    | (_, x) :: _ -> Some (down x +. 4., (i, v))
  in
  let wanted = List.filter_map Fun.id (List.mapi wanted summary.vehicles) in
  let label (at, (i, v)) =
    Style.group i [ Svg.text ~name:("name " ^ Style.vehicle i) (right +. 8., at) (Svg.fit 120. v.id) ]
  in
  let names =
    if List.length wanted > Tracks.most_names then []
    else List.map label (Scale.spread ~least:Tracks.line_height ~from:(y +. 4.) ~until:(y +. height +. 4.) wanted)
  in
  let time_step = Scale.time_step ~most:6 seconds in
  Svg.chart ~left:x ~right ~top:y ~bottom:(y +. height)
    (List.concat_map level (Scale.multiples step ~from:bottom ~until:top)
     @ List.concat_map tick (Scale.multiples time_step ~from:0. ~until:seconds)
     @ [ Svg.rect ~name:"frame" ~x ~y ~width:(right -. x) ~height () ]
     @ List.mapi curve summary.vehicles @ names)
