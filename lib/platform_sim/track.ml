open Dolphin_geo

(* Straight on, or staying if [from] is [towards]. *)
type stretch = { starts : float; lasts : float; from : Position.t; towards : Position.t }
type vertical = Level | Reaching of { rate : float; stays_at : float; swing : swing option }
and swing = { low : float; high : float; slope : float }

type leg = { waypoints : Position.t list; vertical : vertical; speed : float; dwell : float }

type t =
  | Stretches of { stretches : stretch array; heights : Profile.t option; final : Position.t; duration : float }
  (* Without [heights], they are those of the positions. *)
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

(* A way as far as it is known: stretches latest first, each with its phase, and the place and time of its end. *)
type sketch = { reversed : (stretch * Profile.phase) list; here : Position.t; time : float }

let add lasts course towards sketch =
  let stretch = { starts = sketch.time; lasts; from = sketch.here; towards } in
  if not (lasts > 0.) then { sketch with here = towards }
  else
    { reversed = (stretch, { Profile.lasts; course }) :: sketch.reversed; here = towards;
      time = sketch.time +. lasts }

(* To be at [height], or at its swing's height if it [swings]. *)
let course leg height ~swings : Profile.course =
  match leg.vertical with
  | Level -> Keep
  | Reaching { rate; swing = Some { low; high; slope }; _ } when swings -> Swing { low; high; slope; rate }
  | Reaching { rate; _ } -> Reach { height; rate }

let go leg sketch (towards : Position.t) =
  let course = course leg towards.height ~swings:(leg.dwell = 0.) in
  add (Wgs84.distance sketch.here towards /. leg.speed) course towards sketch

let wait leg sketch =
  let height = match leg.vertical with Level -> 0. | Reaching { stays_at; _ } -> stays_at in
  add leg.dwell (course leg height ~swings:true) sketch.here sketch

(* Nothing comes after a stay without end. *)
let follow sketch leg =
  if sketch.time = infinity then sketch else wait leg (List.fold_left (go leg) sketch leg.waypoints)

let sketch here legs = List.fold_left follow { reversed = []; here; time = 0. } legs

let finish ~heights ~duration sketch =
  Stretches { stretches = Array.of_list (List.rev_map fst sketch.reversed); heights; final = sketch.here; duration }

let stay here = finish ~heights:None ~duration:0. (sketch here [])

let through (here : Position.t) legs =
  let s = sketch here legs in
  finish ~heights:(Some (Profile.make here.height (List.rev_map snd s.reversed))) ~duration:s.time s

let there_and_back home place ~speed ~duration =
  let one_way = Float.min (Wgs84.distance home place /. speed) (duration /. 2.) in
  let turn = Wgs84.towards home place (one_way *. speed) in
  let leg waypoint dwell = { waypoints = [ waypoint ]; vertical = Level; speed; dwell } in
  (* [duration], whatever rounding makes of it. *)
  finish ~heights:None ~duration (sketch home [ leg turn (duration -. (2. *. one_way)); leg home 0. ])

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

let on_ground way time =
  match way with
  | Stretches { stretches; final; duration } when time >= duration || stretches = [||] -> final
  | Circuit { home; duration; _ } when time >= duration || time <= 0. -> home
  | Stretches { stretches; _ } ->
    let { starts; lasts; from; towards } = current stretches time 0 (Array.length stretches) in
    if from == towards || lasts = infinity then from else Wgs84.interpolate from towards ((time -. starts) /. lasts)
  | Circuit { centre; outward; radius; laps; duration; _ } ->
    Wgs84.move centre ~bearing:(outward +. (360. *. laps *. time /. duration)) radius

let position way time =
  let here = on_ground way time in
  match way with
  | Stretches { heights = Some profile; duration; _ } ->
    Dolphin_geo.Position.at_height (Profile.height profile (Float.min time duration)) here
  | Stretches { heights = None; _ } | Circuit _ -> here

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
  | Stretches { stretches; heights; duration; _ } ->
    let last = Array.length stretches - 1 in
    let moves_until =
      if last >= 0 && stretches.(last).from == stretches.(last).towards then stretches.(last).starts else duration in
    Option.fold heights ~none:moves_until ~some:(fun profile -> Float.max moves_until (Profile.still_from profile))
