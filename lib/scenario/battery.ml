type doing = Rests | Away | Works | Charges of float

type t = { vehicle : Entry.vehicle; since : float; left : float; rate : float (* its gain in a second *) }

let full = 1.
let hour = 3600.

(* At rest most devices are off. *)
let at_rest = 0.25

let under_way (v : Entry.vehicle) = -.v.drain /. hour
let unplugged v = at_rest *. under_way v
let resting (v : Entry.vehicle) = if v.charge > 0. then v.charge /. hour else unplugged v

let rate v = function
  | Rests -> resting v
  | Away -> unplugged v
  | Works -> under_way v
  | Charges share -> share /. hour

let resting_at (v : Entry.vehicle) place =
  let reaches (charger, radius) = Dolphin_geo.Wgs84.distance charger place <= radius in
  if v.chargers = [] || List.exists reaches v.chargers then Rests else Away

let start (v : Entry.vehicle) =
  { vehicle = v; since = 0.; left = v.battery; rate = rate v (resting_at v v.position) }

let empty_from b =
  if b.left <= 0. && b.rate <= 0. then b.since
  else if b.rate < 0. then b.since -. (b.left /. b.rate)
  else infinity

let full_from b = if b.rate > 0. then b.since +. ((full -. b.left) /. b.rate) else infinity

let level b ~at =
  if at >= empty_from b then 0.
  else if at >= full_from b then full
  else Float.max 0. (Float.min full (b.left +. (b.rate *. (at -. b.since))))

let turn b ~at doing = { b with since = at; left = level b ~at; rate = rate b.vehicle doing }
let is_steady b ~at = b.rate = 0. || at >= empty_from b || at >= full_from b

let least (v : Entry.vehicle) ~working ~until =
  let at_rest = if v.charge > 0. && v.chargers = [] then 0. else unplugged v *. (until -. working) in
  v.battery +. (under_way v *. working) +. at_rest
