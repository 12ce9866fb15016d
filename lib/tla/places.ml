module Position = Dolphin_geo.Position

type t = { mutable latest_first : Position.t list }

let create () = { latest_first = [] }
let positions places = List.rev places.latest_first

let index places p =
  let rec find i = function
    | [] ->
      places.latest_first <- p :: places.latest_first;
      i
    | q :: rest -> if Position.equal p q then i else find (i + 1) rest
  in
  find 1 (positions places)

let texts places = Tla.strings (List.map (Format.asprintf "%a" Position.pp) (positions places))

let millimetres p q =
  let distance = Float.ceil (1000. *. Dolphin_geo.Wgs84.distance p q) in
  if distance >= float_of_int Tla.greatest then Tla.greatest else int_of_float distance

let distances places =
  let all = positions places in
  Tla.Tuple (List.map (fun p -> Tla.Tuple (List.map (fun q -> Tla.Integer (millimetres p q)) all)) all)
