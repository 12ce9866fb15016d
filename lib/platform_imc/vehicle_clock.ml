(* [ahead]: how far the vehicle's clock is ahead of ours, at most, by the datagrams since [opened]; [ahead_before] by
   those of the window before. *)
type t = {
  correction : float;
  latest : float;
  latest_at : float;
  opened : float;
  ahead : float;
  ahead_before : float;
}

let tolerance = 30.
let window = 10.

let unknown =
  { correction = 0.; latest = neg_infinity; latest_at = 0.; opened = neg_infinity; ahead = neg_infinity;
    ahead_before = neg_infinity }

let latest c = c.latest

let observe ~now ~sent c =
  if not (Float.is_finite sent) then (c, c.latest)
  else
    let c =
      if sent +. c.correction >= c.latest -. tolerance then c
      else { c with correction = c.latest +. Float.max 0. (now -. c.latest_at) -. sent }
    in
    let sent = sent +. c.correction in
    let c = if sent > c.latest then { c with latest = sent; latest_at = now } else c in
    let c =
      if now -. c.opened < window then c
      else
        let stale = now -. c.opened >= 2. *. window in
        { c with opened = now; ahead = neg_infinity; ahead_before = (if stale then neg_infinity else c.ahead) }
    in
    ({ c with ahead = Float.max c.ahead (sent -. now) }, sent)

let estimate ~now c =
  let ahead = Float.max c.ahead c.ahead_before in
  if ahead = neg_infinity then neg_infinity else now +. ahead
