type t = { centre : Position.t; radius : float }

let make centre radius = if Float.is_finite radius && radius >= 0. then Some { centre; radius } else None

let accuracy = 1e-3

let contains { centre; radius } position = Wgs84.distance centre position <= radius +. accuracy

let compare a b =
  match Position.compare a.centre b.centre with 0 -> Float.compare a.radius b.radius | order -> order

let equal a b = compare a b = 0

let pp ppf { centre; radius } = Fmt.pf ppf "%a ^ %g m" Position.pp centre radius
