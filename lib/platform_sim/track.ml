open Dolphin_geo

(* Straight on, or staying if [from] is [towards]. *)
type stretch = { starts : float; lasts : float; from : Position.t; towards : Position.t }
type leg = { waypoints : Position.t list; speed : float; dwell : float }

type t =
  | Stretches of { stretches : stretch array; final : Position.t; duration : float }
  | Circuit of {
      home : Position.t;
      centre : Position.t;
      outward : float;
      radius : float;
      laps : float;
      duration : float;
    }
  (* [outward] is the course from the centre to home. *)

(* {1 Making ways} *)

(* A way as far as it is known: stretches latest first, and where and when it ends. *)
type sketch = { reversed : stretch list; here : Position.t; time : float }

let go speed sketch towards =
  let lasts = Wgs84.distance sketch.here towards /. speed in
  let stretch = { starts = sketch.time; lasts; from = sketch.here; towards } in
  if lasts = 0. then { sketch with here = towards }
  else { reversed = stretch :: sketch.reversed; here = towards; time = sketch.time +. lasts }

let wait seconds sketch =
  let stretch = { starts = sketch.time; lasts = seconds; from = sketch.here; towards = sketch.here } in
  if not (seconds > 0.) then sketch
  else { sketch with reversed = stretch :: sketch.reversed; time = sketch.time +. seconds }

(* Nothing comes after a stay without end. *)
let follow sketch leg =
  if sketch.time = infinity then sketch
  else wait leg.dwell (List.fold_left (go leg.speed) sketch leg.waypoints)

let finish sketch =
  let stretches = Array.of_list (List.rev sketch.reversed) in
  Stretches { stretches; final = sketch.here; duration = sketch.time }

let start here = { reversed = []; here; time = 0. }
let stay here = finish (start here)
let through here legs = finish (List.fold_left follow (start here) legs)

let there_and_back home place ~speed ~duration =
  let one_way = Float.min (Wgs84.distance home place /. speed) (duration /. 2.) in
  let turn = Wgs84.towards home place (one_way *. speed) in
  let leg waypoint dwell = { waypoints = [ waypoint ]; speed; dwell } in
  match through home [ leg turn (duration -. (2. *. one_way)); leg home 0. ] with
  | Stretches way -> Stretches { way with duration }  (* whatever rounding has made of it *)
  | Circuit _ as way -> way

let usual_radius = 100.

let circuit home ~bearing ~speed ~duration =
  let turn = 2. *. Float.pi in
  let length = speed *. duration in
  let laps = Float.max 1. (Float.of_int (Float.to_int (length /. (turn *. usual_radius)))) in
  let radius = length /. (turn *. laps) in
  if radius = 0. || not (Float.is_finite radius) then stay home
  else
    let centre = Wgs84.move home ~bearing radius in
    Circuit { home; centre; outward = Wgs84.bearing centre home; radius; laps; duration }

(* {1 Going them} *)

let duration = function
  | Stretches { duration; _ } | Circuit { duration; _ } -> duration

(* The last of [stretches] that has started at [time] at the latest, between [low], which has, and [high]. *)
let rec current stretches time low high =
  if high - low <= 1 then stretches.(low)
  else
    let middle = (low + high) / 2 in
    if stretches.(middle).starts <= time then current stretches time middle high
    else current stretches time low middle

let position way time =
  match way with
  | Stretches { stretches; final; duration } when time >= duration || stretches = [||] -> final
  | Circuit { home; duration; _ } when time >= duration || time <= 0. -> home
  | Stretches { stretches; _ } ->
    let { starts; lasts; from; towards } = current stretches time 0 (Array.length stretches) in
    if from == towards || lasts = infinity then from else Wgs84.interpolate from towards ((time -. starts) /. lasts)
  | Circuit { centre; outward; radius; laps; duration; _ } ->
    Wgs84.move centre ~bearing:(outward +. (360. *. laps *. time /. duration)) radius

let speed way time =
  match way with
  | Stretches { stretches; duration; _ } when time >= duration || stretches = [||] -> 0.
  | Circuit { duration; _ } when time >= duration || time < 0. -> 0.
  | Stretches { stretches; _ } ->
    let { lasts; from; towards; _ } = current stretches time 0 (Array.length stretches) in
    if from == towards || lasts = infinity then 0. else Wgs84.distance from towards /. lasts
  | Circuit { radius; laps; duration; _ } -> 2. *. Float.pi *. radius *. laps /. duration

let still_from = function
  | Circuit { duration; _ } -> duration
  | Stretches { stretches; duration; _ } ->
    let last = Array.length stretches - 1 in
    if last >= 0 && stretches.(last).from == stretches.(last).towards then stretches.(last).starts else duration
