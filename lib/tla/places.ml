module Position = Dolphin_geo.Position
module Area = Dolphin_geo.Area

type place = At of Position.t | Within of Area.t

type t = { mutable latest_first : place list }

let create () = { latest_first = [] }
let all places = List.rev places.latest_first
let positions places = List.filter_map (function At p -> Some p | Within _ -> None) (all places)

let equal p q =
  match p, q with
  | At p, At q -> Position.equal p q
  | Within a, Within b -> Area.equal a b
  | At _, Within _ | Within _, At _ -> false

let number places p =
  let rec find i = function
    | [] ->
      places.latest_first <- p :: places.latest_first;
      i
    | q :: rest -> if equal p q then i else find (i + 1) rest
  in
  find 1 (all places)

let index places p = number places (At p)
let index_of_shape places area = number places (Within area)

let text = function
  | At p -> Format.asprintf "%a" Position.pp p
  | Within area -> Format.asprintf "%a" Area.pp area

let texts places = Tla.strings (List.map text (all places))

let millimetres p q =
  match p, q with
  | At p, At q ->
    let distance = Float.ceil (1000. *. Dolphin_geo.Wgs84.distance p q) in
    if distance >= float_of_int Tla.greatest then Tla.greatest else int_of_float distance
  | Within area, At p | At p, Within area -> if Area.contains area p then 0 else Tla.greatest
  | Within _, Within _ -> 0

let distances places =
  let all = all places in
  Tla.Tuple (List.map (fun p -> Tla.Tuple (List.map (fun q -> Tla.Integer (millimetres p q)) all)) all)
