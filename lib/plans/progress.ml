module Position = Dolphin_geo.Position
module Wgs84 = Dolphin_geo.Wgs84

(* {1 The way}

   Arrays by the places of the way, in order. A dwell without a place of its own is one at the place before. *)

type way = {
  places : Position.t array;
  metres : float array;  (* from each place to the next *)
  speeds : float array;  (* on the way to the next, [nan] if not known *)
  dwells : float array;  (* seconds *)
  radii : float array;
  reached : float array;  (* what the way to each place weighs, as a share is counted *)
  stays : float array;  (* what its dwell weighs *)
  total : float;
  to_first : float;  (* the speed on the way to the first place *)
}

(* A place under construction, with the speed on the way to it: the vehicle's, and the one that shares count. *)
type stop = { place : Position.t; speed : float; counted : float; dwell : float; stay : float; radius : float }

let add_leg stops (leg : Inline_plan.leg) (weighed : Inline_plan.leg) =
  let stop stops place =
    { place; speed = leg.speed; counted = weighed.speed; dwell = 0.; stay = 0.; radius = 0. } :: stops in
  match List.fold_left stop stops leg.waypoints with
  | [] -> []
  | last :: before ->
    let stay = if Float.is_finite weighed.dwell then weighed.dwell else 0. in
    (* Turns at a speed that is not known *)
    let dwell = if Float.is_nan leg.dwell then weighed.dwell else leg.dwell in
    let radius = Float.max last.radius leg.radius in
    { last with dwell = last.dwell +. dwell; stay = last.stay +. stay; radius } :: before

let way_of_stops stops =
  let stops = Array.of_list stops in
  let n = Array.length stops in
  let each f = Array.map f stops and between f = Array.init (n - 1) (fun i -> f stops.(i) stops.(i + 1)) in
  let metres = between (fun a b -> Wgs84.distance a.place b.place) in
  let reached = Array.make n 0. in
  for i = 1 to n - 1 do
    reached.(i) <- reached.(i - 1) +. stops.(i - 1).stay +. (metres.(i - 1) /. stops.(i).counted)
  done;
  {
    places = each (fun s -> s.place);
    metres;
    speeds = between (fun _ b -> b.speed);
    dwells = each (fun s -> s.dwell);
    radii = each (fun s -> s.radius);
    reached;
    stays = each (fun s -> s.stay);
    total = reached.(n - 1) +. stops.(n - 1).stay;
    to_first = stops.(0).speed;
  }

let way ~speed ~from p =
  let path speed = Inline_plan.path ~from ~speed p in
  match List.fold_left2 add_leg [] (path speed) (path 1.) with
  | [] -> None
  | latest_first -> Some (way_of_stops (List.rev latest_first))

(* {1 Progress} *)

(* The vehicle is [ahead] metres beyond a place of the way, or if these are 0, has stayed [stayed] seconds of its dwell
   there. *)
type point = { at : int; ahead : float; stayed : float }

type report = { time : float; place : Position.t }

type t = {
  way : way;
  point : point;
  begun : bool;
  entered : (float * float) option;
  (* when it came near the first place, and how long from there it takes to be at it *)
  nearest : report option;  (* where it was nearest to the first place *)
  matched : report;  (* the last one that was on the way *)
  last : report option;
  awaited : (int * float) option;  (* the next place to stay at, once near, and when the vehicle will be there *)
  pace : float;  (* in metres per second: what was seen of it *)
  timed_from : report option;
}

let beginning = { at = 0; ahead = 0.; stayed = 0. }
let usual_pace = 1.

let start ~speed p =
  match Inline_plan.way_from p with
  | None -> None
  | Some from ->
    let progress way =
      let matched = { time = 0.; place = way.places.(0) } in
      { way; point = beginning; begun = false; entered = None; nearest = None; matched; last = None; awaited = None;
        pace = usual_pace; timed_from = None }
    in
    Option.map progress (way ~speed ~from p)

let done_at way { at; ahead; stayed } =
  if ahead > 0. then
    let weight = way.reached.(at + 1) -. way.reached.(at) -. way.stays.(at) in
    way.reached.(at) +. way.stays.(at) +. (weight *. ahead /. way.metres.(at))
  else
    let share = if way.stays.(at) > 0. then Float.min 1. (stayed /. way.dwells.(at)) else 0. in
    way.reached.(at) +. (way.stays.(at) *. share)

let share t =
  if t.way.total > 0. then Float.max 0. (Float.min 1. (done_at t.way t.point /. t.way.total))
  else 0.

(* {1 Matching a report with the way ahead} *)

(* Metres by which reports of places may err, twice that around a place where it stays, and metres beyond which the
   vehicle is not on its way. *)
let error = 5.
let around = 30.
let off_way = 50.
let squared x = x *. x

(* Seconds by which a vehicle of that speed may be early or late after [seconds]. *)
let slack ~speed seconds = 2. +. (error /. speed) +. (0.15 *. seconds)

(* How unlikely a place is: [off] metres away, reached within [takes] seconds after [seconds] of them. Reports of
   places are more reliable than times, as a vehicle may be held up. *)
let cost ~off ~takes ~speed ~seconds =
  let late = (takes -. seconds) /. slack ~speed seconds in
  squared (off /. error) +. Float.min 4. (squared late)

(* How unlikely it is that a vehicle is seen [metres] behind the place where it was taken to be: less so than that it
   is early. *)
let backwards metres = Float.min 4.5 (squared (Float.max 0. (metres -. error) /. (0.8 *. error)))

(* How unlikely it is that it leaves a place before its time is over. *)
let leaving = 12.

(* The place nearest to [p] between the places [i] and [i + 1]: metres from the former, and metres off. *)
let project way i p =
  let x, y = Wgs84.displacement p way.places.(i) and x', y' = Wgs84.displacement p way.places.(i + 1) in
  let dx = x' -. x and dy = y' -. y in
  let length = squared dx +. squared dy in
  let along = if length > 0. then -.((x *. dx) +. (y *. dy)) /. length else 0. in
  let share = Float.max 0. (Float.min 1. along) in
  (share *. way.metres.(i), Float.hypot (x +. (share *. dx)) (y +. (share *. dy)))

type candidate = { cost : float; off : float; takes : float; reaches : point }

let candidate ~off ~takes ~speed ~seconds reaches =
  { cost = cost ~off ~takes ~speed ~seconds; off; takes; reaches }

let better a b = if b.cost < a.cost then b else a

let known_or_pace t speed = if speed > 0. then speed else t.pace
let speed t i = if i < Array.length t.way.speeds then known_or_pace t t.way.speeds.(i) else t.pace

(* [staying t i ~stayed ~after p ~seconds] is that of a vehicle which comes to place [i] after some of [seconds], and
   may be anywhere around it then. *)
let staying t i ~stayed ~after p ~seconds =
  let { places; dwells; radii; _ } = t.way in
  let after =
    match t.awaited with
    | Some (j, time) when i = j -> Float.min after (Float.max 0. (time -. t.matched.time))
    | Some _ | None -> after
  in
  let left = dwells.(i) -. stayed and metres = Wgs84.distance p places.(i) in
  (* Once the time is over, it moves on. *)
  let gone = Float.min off_way (Float.max 0. (seconds -. after -. left) *. speed t i) in
  let off =
    if left > 0. && after <= seconds then Float.min metres (Float.max gone (metres -. radii.(i) -. around))
    else metres
  in
  let more = Float.max 0. (Float.min left (seconds -. after)) in
  candidate ~off ~takes:(after +. more) ~speed:(speed t i) ~seconds { at = i; ahead = 0.; stayed = stayed +. more }

let whole dwell = if Float.is_finite dwell then dwell else 0.

(* The best place within [window] metres from [from] on, where the vehicle was [seconds] ago but for [after] of them. *)
let search t ~from ~after ~window p ~seconds =
  let { places; dwells; metres; _ } = t.way in
  let rec go i ~stayed ~ahead ~after ~behind ~early best =
    let unless_early c = { c with cost = c.cost +. early } in
    let best = if ahead > 0. then best else better best (unless_early (staying t i ~stayed ~after p ~seconds)) in
    if i = Array.length places - 1 then best
    else
      let left = if ahead > 0. then 0. else dwells.(i) -. stayed in
      let after = after +. left in
      let early = if left > 0. && after > seconds +. slack ~speed:(speed t i) seconds then leaving else early in
      let seen, off = project t.way i p in
      let metres_ahead = Float.max ahead seen in
      let takes = after +. ((metres_ahead -. ahead) /. speed t i) in
      let reaches =
        if metres_ahead >= metres.(i) then { at = i + 1; ahead = 0.; stayed = 0. }
        else { at = i; ahead = metres_ahead; stayed = (if metres_ahead > 0. then 0. else whole dwells.(i)) }
      in
      let c = candidate ~off ~takes ~speed:(speed t i) ~seconds reaches in
      let best = better best { c with cost = c.cost +. early +. backwards (metres_ahead -. seen) } in
      let behind = behind +. metres.(i) -. ahead in
      if behind > window then best
      else
        let after = after +. ((metres.(i) -. ahead) /. speed t i) in
        go (i + 1) ~stayed:0. ~ahead:0. ~after ~behind ~early best
  in
  go from.at ~stayed:from.stayed ~ahead:from.ahead ~after ~behind:0. ~early:0.
    { cost = infinity; off = infinity; takes = infinity; reaches = from }

let reach ~moved ~speed ~seconds = (1.5 *. Float.max moved (speed *. seconds)) +. 30.

(* Since a vehicle may stay beside the place, it is taken to be there once it has had the time. *)
let await ~at p t =
  let i = t.point.at + 1 in
  let { places; dwells; radii; metres; _ } = t.way in
  match t.awaited with
  | Some (j, _) when i = j -> t
  | Some _ | None ->
    if i < Array.length places && dwells.(i) > 0. && Wgs84.distance p places.(i) <= radii.(i) +. around then
      let left = metres.(t.point.at) -. t.point.ahead in
      { t with awaited = Some (i, at +. (left /. speed t t.point.at)) }
    else t

let advance ~at p t =
  let seconds = Float.max 0. (at -. t.matched.time) in
  let moved = Wgs84.distance t.matched.place p in
  let seen = if seconds > 0. then (moved -. (2. *. error)) /. seconds else 0. in
  let pace = Float.max t.pace seen in
  let window = reach ~moved ~speed:(speed t t.point.at) ~seconds in
  let best = search { t with pace } ~from:t.point ~after:0. ~window p ~seconds in
  if best.off > off_way then t
  else await ~at p { t with point = best.reaches; matched = { time = at; place = p } }

(* {1 The way to the first place} *)

let begin_at time p t = { t with begun = true; matched = { time; place = p } }

(* How near the vehicle has come, and how long it has been near. *)
let approached ~at p metres t =
  let nearest =
    match t.nearest with
    | Some { place; _ } when Wgs84.distance place t.way.places.(0) <= metres -> t.nearest
    | Some _ | None -> Some { time = at; place = p }
  in
  { t with nearest }

(* A report that shows the vehicle behind its first place, which it has come to between two reports. *)
let seen_beyond ~at p ~speed t { time; place } =
  let seconds = Float.max 0. (at -. time) and moved = Wgs84.distance place p in
  let before = Wgs84.distance place t.way.places.(0) and now = Wgs84.distance p t.way.places.(0) in
  let window = reach ~moved ~speed ~seconds -. before in
  if moved < 2. *. error || window < 0. then None
  else
    let best = search t ~from:beginning ~after:(before /. speed) ~window p ~seconds in
    let errs takes = Float.abs (takes -. seconds) in
    if best.off <= 3. *. error && errs best.takes < errs ((before -. now) /. speed) then Some best.reaches else None

(* A vehicle that goes away along the way was at its beginning, even if it was not seen there. *)
let goes_away ~at p t { time; place } =
  let first = t.way.places.(0) in
  if Wgs84.distance p first < Wgs84.distance place first +. (2. *. error) then None
  else
    let seconds = Float.max 0. (at -. time) and moved = Wgs84.distance place p in
    let window = reach ~moved ~speed:(speed t 0) ~seconds in
    let best = search t ~from:beginning ~after:0. ~window p ~seconds in
    if best.off <= 3. *. error then Some best.reaches else None

let approach ~at p t =
  let first = t.way.places.(0) in
  let metres = Wgs84.distance p first in
  let speed = known_or_pace t t.way.to_first in
  let radius = t.way.radii.(0) in
  let near = if t.way.dwells.(0) > 0. then radius +. around else Float.max radius around in
  let t = approached ~at p metres t in
  let t =
    if metres <= near && t.entered = None then { t with entered = Some (at, metres /. speed) } else t in
  let passed =
    match t.nearest with
    | Some r ->
      let least = Wgs84.distance r.place first in
      if least <= near && metres > least +. (2. *. error) then Some r else None
    | None -> None
  in
  let seen =
    match Option.bind t.last (seen_beyond ~at p ~speed t) with
    | Some point -> Some point
    | None -> Option.bind t.nearest (goes_away ~at p t)
  in
  match seen, passed, t.entered with
  | Some point, _, _ -> { (begin_at at p t) with point }
  | None, _, _ when metres <= 2. *. error -> begin_at at p t
  | None, Some r, _ -> advance ~at p (begin_at r.time r.place t)
  | None, None, Some (entered, takes) when metres <= near && at > entered +. takes +. slack ~speed takes ->
    advance ~at p (begin_at (entered +. takes) p t)
  | None, None, (Some _ | None) -> t

(* {1 Reports} *)

(* Over some seconds, as places err. At turns a vehicle is faster than it seems. *)
let timed ~at p t =
  match t.timed_from with
  | None -> { t with timed_from = Some { time = at; place = p } }
  | Some { time; place } when at -. time >= 10. ->
    let seen = Wgs84.distance place p /. (at -. time) in
    { t with pace = Float.max 0.1 (Float.max seen (0.8 *. t.pace)); timed_from = Some { time = at; place = p } }
  | Some _ -> t

let observe ~at p t =
  let t = timed ~at p t in
  let t = if t.begun then advance ~at p t else approach ~at p t in
  { t with last = Some { time = at; place = p } }
