type t = { latitude : float; longitude : float; height : float }

type error = Latitude of float | Longitude of float | Height of float

let lowest = -20_000.
let highest = 1e6

let within bound x = Float.abs x <= bound (* false for NaN *)

let make ~latitude ~longitude ~height =
  if not (within 90. latitude) then Error (Latitude latitude)
  else if not (within 180. longitude) then Error (Longitude longitude)
  else if not (lowest <= height && height <= highest) then Error (Height height)
  else Ok { latitude; longitude; height }

let at_height height p = { p with height = Float.max lowest (Float.min highest height) }

let compare a b =
  match Float.compare a.latitude b.latitude with
  | 0 -> (
      match Float.compare a.longitude b.longitude with
      | 0 -> Float.compare a.height b.height
      | order -> order)
  | order -> order

let equal a b = compare a b = 0

(* [pp_fixed decimals] never prints a negative zero. *)
let pp_fixed decimals ppf x =
  let half_unit = 0.5 *. (10. ** float_of_int (-decimals)) in
  Fmt.pf ppf "%.*f" decimals (if Float.abs x < half_unit then 0. else x)

let pp ppf { latitude; longitude; height } =
  let pp_height ppf height = if Float.abs height >= 0.05 then Fmt.pf ppf ", %a m" (pp_fixed 1) height in
  Fmt.pf ppf "(%a, %a%a)" (pp_fixed 6) latitude (pp_fixed 6) longitude pp_height height

let pp_error ppf = function
  | Latitude x -> Fmt.pf ppf "latitude %g is not from -90 to 90 degrees" x
  | Longitude x -> Fmt.pf ppf "longitude %g is not from -180 to 180 degrees" x
  | Height x -> Fmt.pf ppf "height %g is not from %.0f to %.0f metres" x lowest highest
