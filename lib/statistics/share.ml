type interval = { least : float; most : float }

(* {1 The incomplete beta function} *)

(* log Gamma(x) for x >= 1, by Stirling's series where it is good to 15 digits. *)
let rec log_gamma x =
  if x < 16. then log_gamma (x +. 1.) -. log x
  else
    let y = 1. /. (x *. x) in
    let series = (1. /. 12.) -. (y *. ((1. /. 360.) -. (y *. ((1. /. 1260.) -. (y /. 1680.))))) in
    ((x -. 0.5) *. log x) -. x +. (0.5 *. log (2. *. Float.pi)) +. (series /. x)

(* The continued fraction of I_x(a, b) (DLMF 8.17.22), by Lentz's method; it converges for x < (a + 1) / (a + b + 2). *)
let continued_fraction a b x =
  let away_from_zero y = if Float.abs y < 1e-300 then 1e-300 else y in
  let term m =
    let m' = Float.of_int (m / 2) in
    if m mod 2 = 0 then m' *. (b -. m') *. x /. ((a +. (2. *. m') -. 1.) *. (a +. (2. *. m')))
    else -.(a +. m') *. (a +. b +. m') *. x /. ((a +. (2. *. m')) *. (a +. (2. *. m') +. 1.))
  in
  let rec go m c d value =
    let t = term m in
    let d = 1. /. away_from_zero (1. +. (t *. d)) and c = away_from_zero (1. +. (t /. c)) in
    let value = value *. c *. d in
    if Float.abs ((c *. d) -. 1.) < 1e-15 || m > 100_000 then value else go (m + 1) c d value
  in
  1. /. go 1 1. 0. 1.

(* I_x(a, b): the probability that a + b - 1 samples, each of which hits with probability x, hit a times or more. *)
let rec incomplete_beta a b x =
  if x <= 0. then 0.
  else if x >= 1. then 1.
  else if x > (a +. 1.) /. (a +. b +. 2.) then 1. -. incomplete_beta b a (1. -. x)
  else
    let front =
      (a *. log x) +. (b *. Float.log1p (-.x)) +. log_gamma (a +. b) -. log_gamma a -. log_gamma b -. log a in
    exp front *. continued_fraction a b x

(* The point at which the growing function [f] passes [y]. *)
let inverse f y =
  let rec between low high n =
    let middle = (low +. high) /. 2. in
    if n = 0 then middle else if f middle < y then between middle high (n - 1) else between low middle (n - 1)
  in
  between 0. 1. 60

(* {1 Intervals} *)

let interval ~level ~hits n =
  if hits < 0 || hits > n || not (level > 0. && level < 1.) then invalid_arg "Share.interval";
  let tail = (1. -. level) /. 2. and k = Float.of_int hits and misses = Float.of_int (n - hits) in
  { least = (if hits = 0 then 0. else inverse (incomplete_beta k (misses +. 1.)) tail);
    most = (if hits = n then 1. else inverse (incomplete_beta (k +. 1.) misses) (1. -. tail)) }

let half_width i = (i.most -. i.least) /. 2.

(* {1 Looks} *)

let rec look j = if j <= 1 then 100 else (look (j - 1) * 5 / 4)
let level_of_look ~level j = 1. -. ((1. -. level) /. Float.of_int (j * (j + 1)))
