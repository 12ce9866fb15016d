(* [ahead]: how far the vehicle's clock is ahead of ours, at most, by the datagrams since [opened]; [ahead_before] by
   those of the window before. *)
type t = {
  correction : float;
  latest : float;
  latest_at : float;
  opened : float;
  ahead : float;
  ahead_before : float;
  stray : stray option;
  strays : int;
}

(* Stamps that are not taken: the last one, when it came, and how many in a row fit one clock. *)
and stray = { stamp : float; at : float; count : int }

let tolerance = 30.
let window = 10.
let farthest = 86400.
let leap = 5.
let persistence = 5

(* Beyond it a stamp does not resolve microseconds. *)
let greatest = 1e11

let unknown =
  { correction = 0.; latest = neg_infinity; latest_at = 0.; opened = neg_infinity; ahead = neg_infinity;
    ahead_before = neg_infinity; stray = None; strays = 0 }

let latest c = c.latest
let strays c = c.strays

(* The clock at [now] if it goes as fast as ours. *)
let expected ~now c = c.latest +. Float.max 0. (now -. c.latest_at)

let take ~now ~sent c =
  let c =
    if sent +. c.correction >= c.latest -. tolerance then c else { c with correction = expected ~now c -. sent }
  in
  let sent = sent +. c.correction in
  let c = if sent > c.latest then { c with latest = sent; latest_at = now } else c in
  let c =
    if now -. c.opened < window then c
    else
      let stale = now -. c.opened >= 2. *. window in
      { c with opened = now; ahead = neg_infinity; ahead_before = (if stale then neg_infinity else c.ahead) }
  in
  ({ c with ahead = Float.max c.ahead (sent -. now); stray = None }, sent)

(* A clock that was set is believed once it persists. *)
let doubt ~now ~sent c =
  let count =
    match c.stray with
    | Some s when Float.abs (sent -. s.stamp -. (now -. s.at)) <= tolerance -> s.count + 1
    | Some _ | None -> 1
  in
  if count >= persistence then take ~now ~sent { c with correction = expected ~now c -. sent }
  else
    let is_stray = Float.abs (sent +. c.correction -. expected ~now c) > farthest in
    let strays = if is_stray then c.strays + 1 else c.strays in
    ({ c with stray = Some { stamp = sent; at = now; count }; strays }, c.latest)

let observe ~now ~sent c =
  let ahead = sent +. c.correction -. expected ~now c in
  if not (Float.abs sent <= greatest) then ({ c with strays = c.strays + 1 }, c.latest)
  else if c.latest = neg_infinity || (ahead <= leap && ahead >= -.farthest) then take ~now ~sent c
  else doubt ~now ~sent c

let estimate ~now c =
  let ahead = Float.max c.ahead c.ahead_before in
  if ahead = neg_infinity then neg_infinity else now +. ahead
