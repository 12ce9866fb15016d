type t = {
  next_announce : float;
  last_announce : float;
  next_heartbeat : float;
  next_eager : float;
}

let announce_interval = 10.
let eager_announce_interval = 1.
let heartbeat_interval = 1.
let eager_heartbeat_interval = 0.2

(* New systems make us announce at once, but not more often than this. *)
let least_announce_interval = 0.25

let start = { next_announce = 0.; last_announce = neg_infinity; next_heartbeat = 0.; next_eager = infinity }
let hasten ~at p = { p with next_eager = Float.min p.next_eager at }

let met ~now p =
  let p = hasten ~at:now p in
  let earliest = p.last_announce +. least_announce_interval in
  if now -. p.last_announce < least_announce_interval then
    ({ p with next_announce = Float.min p.next_announce earliest }, false)
  else ({ p with last_announce = now; next_announce = now +. eager_announce_interval }, true)

let announce ~now ~awaited p =
  if now < p.next_announce then (p, false)
  else
    let interval = if awaited then eager_announce_interval else announce_interval in
    ({ p with next_announce = now +. interval; last_announce = now }, true)

type heartbeats = All | Awaited | Nobody

let beat ~now ~awaited p =
  let next_eager = if awaited then now +. eager_heartbeat_interval else infinity in
  if now >= p.next_heartbeat then ({ p with next_heartbeat = now +. heartbeat_interval; next_eager }, All)
  else if now >= p.next_eager then ({ p with next_eager }, Awaited)
  else (p, Nobody)

let due p = Float.min p.next_announce (Float.min p.next_heartbeat p.next_eager)
